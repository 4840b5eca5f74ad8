//! A device of wgpu's that runs compute shaders over buffers.

use crate::Result;
use wgpu::{
    BindGroup, BindGroupDescriptor, BindGroupEntry, BindGroupLayout, BindGroupLayoutDescriptor,
    BindGroupLayoutEntry, BindingType, Buffer, BufferBindingType, BufferDescriptor, BufferUsages,
    ComputePipeline, ComputePipelineDescriptor, Device, DeviceDescriptor, ErrorFilter, Features, Instance,
    InstanceDescriptor, Limits, MapMode, PipelineLayoutDescriptor, PollType, Queue, ShaderModuleDescriptor,
    ShaderSource, ShaderStages,
};

/// The device.
pub struct Gpu {
    device: Device,
    queue: Queue,
    /// Its name and driver.
    pub name: String,
}

/// What a binding of a shader holds.
pub enum Binding<'a> {
    /// Bytes to read.
    Input(&'a [u8]),
    /// So many bytes to write.
    Output(usize),
}

impl Gpu {
    /// The first device of Vulkan whose name contains this.
    pub fn new(name: &str) -> Result<Self> {
        let instance = Instance::new(InstanceDescriptor::new_without_display_handle());
        let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::VULKAN));
        let adapter = adapters.into_iter().find(|adapter| adapter.get_info().name.contains(name));
        let adapter = adapter.ok_or_else(|| format!("wgpu finds no device with `{name}` in its name"))?;
        // The kernels have their count as a push constant, which wgpu calls immediates.
        let wanted = DeviceDescriptor {
            required_features: Features::IMMEDIATES,
            required_limits: Limits { max_immediate_size: 4, ..Limits::default() },
            ..DeviceDescriptor::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&wanted))?;
        let info = adapter.get_info();
        Ok(Self { device, queue, name: format!("{}, {}", info.name, info.driver_info) })
    }

    /// Runs a shader's entry point with these buffers as its bindings 0, 1, …, and `count` as immediates, where the shader
    /// has any. Returns what it writes to each output.
    pub fn run(
        &self,
        source: ShaderSource<'_>,
        entry: &str,
        bindings: &[Binding<'_>],
        count: Option<u32>,
        workgroups: u32,
    ) -> Result<Vec<Vec<u8>>> {
        let scope = self.device.push_error_scope(ErrorFilter::Validation);
        let entries: Vec<BindGroupLayoutEntry> = (0..).zip(bindings).map(layout_entry).collect();
        let layout = self
            .device
            .create_bind_group_layout(&BindGroupLayoutDescriptor { label: None, entries: &entries });
        let pipeline = self.pipeline(source, entry, &layout, count.map_or(0, |_| 4));
        let buffers: Vec<Buffer> = bindings.iter().map(|binding| self.buffer(binding)).collect();
        let group = self.group(&layout, &buffers);
        self.dispatch(&pipeline, &group, count, workgroups);
        if let Some(error) = pollster::block_on(scope.pop()) {
            return Err(error.into());
        }
        let outputs = bindings.iter().zip(&buffers);
        outputs
            .filter(|(binding, _)| matches!(binding, Binding::Output(_)))
            .map(|(_, buffer)| self.read(buffer))
            .collect()
    }

    fn pipeline(
        &self,
        source: ShaderSource<'_>,
        entry: &str,
        group: &BindGroupLayout,
        immediate_size: u32,
    ) -> ComputePipeline {
        let module = self.device.create_shader_module(ShaderModuleDescriptor { label: None, source });
        let layout = self.device.create_pipeline_layout(&PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(group)],
            immediate_size,
        });
        self.device.create_compute_pipeline(&ComputePipelineDescriptor {
            label: None,
            layout: Some(&layout),
            module: &module,
            entry_point: Some(entry),
            compilation_options: Default::default(),
            cache: None,
        })
    }

    /// These buffers as bindings 0, 1, …
    fn group(&self, layout: &BindGroupLayout, buffers: &[Buffer]) -> BindGroup {
        let entries: Vec<BindGroupEntry<'_>> = (0..)
            .zip(buffers)
            .map(|(binding, buffer)| BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        self.device.create_bind_group(&BindGroupDescriptor { label: None, layout, entries: &entries })
    }

    fn dispatch(&self, pipeline: &ComputePipeline, group: &BindGroup, count: Option<u32>, workgroups: u32) {
        let mut commands = self.device.create_command_encoder(&Default::default());
        let mut pass = commands.begin_compute_pass(&Default::default());
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, group, &[]);
        if let Some(count) = count {
            pass.set_immediates(0, &count.to_le_bytes());
        }
        pass.dispatch_workgroups(workgroups, 1, 1);
        drop(pass);
        self.queue.submit([commands.finish()]);
    }

    fn buffer(&self, binding: &Binding<'_>) -> Buffer {
        let size = match binding {
            Binding::Input(bytes) => bytes.len(),
            Binding::Output(size) => *size,
        };
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
        let buffer = self.create(size as u64, usage);
        if let Binding::Input(bytes) = binding {
            self.queue.write_buffer(&buffer, 0, bytes);
        }
        buffer
    }

    fn create(&self, size: u64, usage: BufferUsages) -> Buffer {
        self.device.create_buffer(&BufferDescriptor { label: None, size, usage, mapped_at_creation: false })
    }

    fn read(&self, buffer: &Buffer) -> Result<Vec<u8>> {
        let copy = self.create(buffer.size(), BufferUsages::MAP_READ | BufferUsages::COPY_DST);
        let mut commands = self.device.create_command_encoder(&Default::default());
        commands.copy_buffer_to_buffer(buffer, 0, &copy, 0, buffer.size());
        self.queue.submit([commands.finish()]);
        let (sender, receiver) = std::sync::mpsc::channel();
        copy.map_async(MapMode::Read, .., move |mapped| {
            // The receiver is there until all is done.
            let _ = sender.send(mapped);
        });
        self.device.poll(PollType::wait_indefinitely())?;
        receiver.recv()??;
        Ok(copy.get_mapped_range(..)?.to_vec())
    }
}

fn layout_entry((binding, kind): (u32, &Binding<'_>)) -> BindGroupLayoutEntry {
    let read_only = matches!(kind, Binding::Input(_));
    let ty = BindingType::Buffer {
        ty: BufferBindingType::Storage { read_only },
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    BindGroupLayoutEntry { binding, visibility: ShaderStages::COMPUTE, ty, count: None }
}
