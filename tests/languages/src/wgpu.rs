//! wgpu, which takes WGSL through naga to SPIR-V.

use crate::cases::{COUNT, Case};
use crate::job::Job;
use crate::tally::Tally;
use crate::{Result, told};
use unitvec_run::shader::kernel::ENTRY_POINT;
use unitvec_vulkan::{GROUP, WORKGROUP};
use wgpu::{
    BindGroupDescriptor, BindGroupEntry, Buffer, BufferDescriptor, BufferUsages, ComputePipeline,
    ComputePipelineDescriptor, Device, ErrorFilter, Instance, InstanceDescriptor, MapMode, PollType, Queue,
    ShaderModuleDescriptor, ShaderSource,
};

pub struct Wgpu {
    device: Device,
    queue: Queue,
    driver: String,
}

impl Wgpu {
    /// The first device whose name contains this, in any case.
    pub fn new(name: &str) -> Result<Self> {
        let instance = Instance::new(InstanceDescriptor::new_without_display_handle());
        let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::VULKAN));
        let named = |adapter: &wgpu::Adapter| adapter.get_info().name.to_lowercase().contains(name);
        let adapter = adapters.into_iter().find(named).ok_or_else(|| format!("wgpu finds no {name}"))?;
        let (device, queue) =
            pollster::block_on(adapter.request_device(&Default::default())).map_err(told)?;
        Ok(Self { device, queue, driver: adapter.get_info().driver_info })
    }

    /// Name and version of its driver.
    pub fn driver(&self) -> &str {
        &self.driver
    }

    pub fn run(&self, jobs: &[Job<'_>], tally: &mut Tally) -> Result<()> {
        for job in jobs {
            tally.add(
                job.case,
                self.compile(&job.text).and_then(|pipeline| self.dispatch(&pipeline, job.case)),
            )?;
        }
        Ok(())
    }

    fn compile(&self, text: &str) -> Result<ComputePipeline> {
        let scope = self.device.push_error_scope(ErrorFilter::Validation);
        let source = ShaderSource::Wgsl(text.into());
        let module = self.device.create_shader_module(ShaderModuleDescriptor { label: None, source });
        let pipeline = self.device.create_compute_pipeline(&ComputePipelineDescriptor {
            label: None,
            layout: None,
            module: &module,
            entry_point: Some(ENTRY_POINT),
            compilation_options: Default::default(),
            cache: None,
        });
        match pollster::block_on(scope.pop()) {
            Some(error) => Err(error.to_string()),
            None => Ok(pipeline),
        }
    }

    fn dispatch(&self, pipeline: &ComputePipeline, case: &Case) -> Result<Vec<u32>> {
        let size = size_of_val(case.expected.as_slice()) as u64;
        let input: &[u8] = bytemuck::cast_slice(&case.input);
        let words = self.buffer(input.len() as u64, BufferUsages::STORAGE | BufferUsages::COPY_DST);
        let results = self.buffer(size, BufferUsages::STORAGE | BufferUsages::COPY_SRC);
        let read = self.buffer(size, BufferUsages::MAP_READ | BufferUsages::COPY_DST);
        self.queue.write_buffer(&words, 0, input);
        let group = self.device.create_bind_group(&BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[
                BindGroupEntry { binding: 0, resource: words.as_entire_binding() },
                BindGroupEntry { binding: 1, resource: results.as_entire_binding() },
            ],
        });
        let mut commands = self.device.create_command_encoder(&Default::default());
        let mut pass = commands.begin_compute_pass(&Default::default());
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(COUNT.div_ceil(GROUP * WORKGROUP) as u32, 1, 1);
        drop(pass);
        commands.copy_buffer_to_buffer(&results, 0, &read, 0, size);
        self.queue.submit([commands.finish()]);
        let (sender, receiver) = std::sync::mpsc::channel();
        read.map_async(MapMode::Read, .., move |mapped| {
            // The receiver is there until all is done.
            let _ = sender.send(mapped);
        });
        self.device.poll(PollType::wait_indefinitely()).map_err(told)?;
        receiver.recv().map_err(told)?.map_err(told)?;
        Ok(bytemuck::pod_collect_to_vec(&read.get_mapped_range(..).map_err(told)?))
    }

    fn buffer(&self, size: u64, usage: BufferUsages) -> Buffer {
        self.device.create_buffer(&BufferDescriptor { label: None, size, usage, mapped_at_creation: false })
    }
}
