//! Compute kernels and what runs them: pipelines, staging and dispatches share the lifetimes that their `unsafe` calls rely
//! on, and so stand in one file.

use super::buffer::{Buffer, Place};
use super::{Device, Error, Named, spirv};
use ash::vk;
use std::rc::Rc;
use std::sync::{Arc, PoisonError};

/// Bytes of the largest element a buffer holds: a tangent frame of seven f32.
pub(super) const MAX_ELEMENT: usize = 28;

/// Vectors of one invocation, but for kernels that measure.
pub const GROUP: usize = 4;

/// Invocations of one workgroup.
pub const WORKGROUP: usize = 64;

/// What output buffers are filled with before a run, so that output which a kernel fails to write stands out: NaN as
/// a component, and a code that none of the tests' inputs gives throughout.
pub const SENTINEL: u32 = 0x7fc0_dead;

/// A compute kernel with the interface of `spirv/manifest.json`: binding 0 in, binding 1 out, binding 2 a table, the
/// number of vectors as push constant.
pub struct Kernel {
    pipeline: vk::Pipeline,
    layout: Arc<Layout>,
    table: Option<Table>,
    buffers: Buffers,
}

/// What a kernel can rely on: specialization constant 0 of those with the interface of `spirv/manifest.json`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u32)]
pub enum Buffers {
    /// Buffers hold no more than the vectors and codes, and maybe less than the push constant says.
    #[default]
    ExactSize = 0,
    /// Buffers hold whole groups of [`GROUP`] vectors, all that the push constant says. The last group's results beyond
    /// that number mean nothing.
    WholeGroups = 1,
}

/// Constant data on a device, for kernels to look things up in.
#[derive(Clone)]
pub struct Table {
    data: Rc<Staged>,
    layout: Arc<Layout>,
}

/// What a dispatch does.
struct Dispatch<'a> {
    kernel: &'a Kernel,
    workgroups: u32,
    constants: [u32; 2],
}

/// The interface that all kernels share.
pub(super) struct Layout {
    set: vk::DescriptorSetLayout,
    pipeline: vk::PipelineLayout,
    pub(super) device: Arc<Device>,
}

/// Runs kernels on a device: two buffers, in and out, staged where the host does not see the device's memory.
pub struct Runner {
    device: Arc<Device>,
    layout: Arc<Layout>,
    input: Staged,
    output: Staged,
    pool: vk::CommandPool,
    commands: vk::CommandBuffer,
    descriptors: vk::DescriptorPool,
    set: vk::DescriptorSet,
    fence: vk::Fence,
    queries: vk::QueryPool,
    capacity: usize,
    fill_output: bool,
}

/// Bytes that hold whole groups of any element.
fn buffer_size(vectors: usize) -> usize {
    vectors.next_multiple_of(GROUP) * MAX_ELEMENT
}

/// A device buffer and, where the host cannot map it, its staging buffer.
struct Staged {
    device: Buffer,
    staging: Option<Buffer>,
}

impl Staged {
    fn new(device: &Arc<Device>, size: usize) -> Result<Self, Error> {
        let buffer = Buffer::new(device, size, Place::Device)?;
        let staging = if buffer.is_mapped() { None } else { Some(Buffer::new(device, size, Place::Host)?) };
        Ok(Self { device: buffer, staging })
    }

    fn host(&self) -> &Buffer {
        self.staging.as_ref().unwrap_or(&self.device)
    }

    fn host_mut(&mut self) -> &mut Buffer {
        self.staging.as_mut().unwrap_or(&mut self.device)
    }
}

impl Runner {
    /// A runner for up to `capacity` vectors at a time. With `fill_output`, output memory is overwritten before each
    /// run, so that what a kernel fails to write cannot pass for its result.
    ///
    /// # Errors
    /// [`Error::BadCount`] for a capacity of 0 or beyond the device's limits, [`Error::MissingFeature`], or a failed call.
    pub fn new(device: &Arc<Device>, capacity: usize, fill_output: bool) -> Result<Self, Error> {
        if capacity == 0 || capacity > device.max_vectors {
            return Err(Error::BadCount { vectors: capacity, limit: device.max_vectors });
        }
        let size = buffer_size(capacity);
        let layout = Arc::new(Layout::new(device)?);
        let mut runner = Self {
            device: device.clone(),
            layout,
            input: Staged::new(device, size)?,
            output: Staged::new(device, size)?,
            pool: vk::CommandPool::null(),
            commands: vk::CommandBuffer::null(),
            descriptors: vk::DescriptorPool::null(),
            set: vk::DescriptorSet::null(),
            fence: vk::Fence::null(),
            queries: vk::QueryPool::null(),
            capacity,
            fill_output,
        };
        runner.create_commands()?;
        runner.create_descriptors()?;
        Ok(runner)
    }

    /// The most vectors that [`run`](Self::run) takes.
    pub fn capacity(&self) -> usize {
        self.capacity
    }

    /// The device it runs on.
    pub fn device(&self) -> &Arc<Device> {
        &self.device
    }

    /// Makes a kernel of a SPIR-V module, for buffers of exact size. One that reads binding 2 needs a table.
    ///
    /// The module is trusted to be valid: drivers do not check. Its framing and the entry point are checked here.
    ///
    /// # Errors
    /// [`Error::NotSpirv`], [`Error::ForeignKernel`] for a table of another runner, or a failed call.
    pub fn kernel(&self, spirv: &[u8], entry_point: &str, table: Option<&Table>) -> Result<Kernel, Error> {
        self.kernel_for(Buffers::ExactSize, spirv, entry_point, table)
    }

    /// Makes a kernel as [`kernel`](Self::kernel) does, for these buffers. A module without the specialization constant is
    /// the same for all.
    ///
    /// # Errors
    /// As [`kernel`](Self::kernel).
    pub fn kernel_for(
        &self,
        buffers: Buffers,
        spirv: &[u8],
        entry_point: &str,
        table: Option<&Table>,
    ) -> Result<Kernel, Error> {
        if table.is_some_and(|table| !Arc::ptr_eq(&table.layout, &self.layout)) {
            return Err(Error::ForeignKernel);
        }
        Kernel::new(&self.layout, buffers, spirv, entry_point, table.cloned())
    }

    /// Puts a table on the device.
    ///
    /// # Errors
    /// A failed call; [`Error::BadCount`] for one that is empty or exceeds the device's limits.
    pub fn table(&mut self, bytes: &[u8]) -> Result<Table, Error> {
        let limit = self.device.max_vectors * MAX_ELEMENT;
        if bytes.is_empty() || bytes.len() > limit {
            return Err(Error::BadCount {
                vectors: bytes.len() / MAX_ELEMENT,
                limit: self.device.max_vectors,
            });
        }
        let mut data = Staged::new(&self.device, bytes.len())?;
        data.host_mut().write(bytes);
        if let Some(staging) = &data.staging {
            let device = &self.device.raw;
            // SAFETY: the command buffer is not in use, since each submission is waited for; both buffers have the
            // table's size; the barrier orders the copy before the dispatches of later submissions.
            unsafe {
                begin(device, self.commands)?;
                copy(device, self.commands, staging, &data.device, bytes.len());
                barrier(device, self.commands, Step::Transfer, Step::Compute);
                device.end_command_buffer(self.commands).named("vkEndCommandBuffer")?;
            }
            self.submit_and_wait()?;
        }
        data.staging = None;
        Ok(Table { data: Rc::new(data), layout: self.layout.clone() })
    }

    /// Runs `kernel` on `vectors` vectors and waits for it. Returns the nanoseconds that the device took for the
    /// kernel alone, where it has timestamps.
    ///
    /// # Errors
    /// [`Error::BadCount`], [`Error::ForeignKernel`] for a kernel of another runner, or a failed call.
    pub fn run(
        &mut self,
        kernel: &Kernel,
        vectors: usize,
        input: &[u8],
        output: &mut [u8],
    ) -> Result<Option<f64>, Error> {
        self.check(kernel, vectors)?;
        let workgroups = vectors.div_ceil(GROUP * WORKGROUP) as u32;
        self.dispatch(&Dispatch { kernel, workgroups, constants: [vectors as u32, 0] }, input, output)
    }

    /// Runs a cost kernel, of one vector an invocation, `repetitions` times each, as [`run`](Self::run).
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn run_cost(
        &mut self,
        kernel: &Kernel,
        vectors: usize,
        repetitions: u32,
        input: &[u8],
        output: &mut [u8],
    ) -> Result<Option<f64>, Error> {
        self.check(kernel, vectors)?;
        let limit = self.device.max_vectors / GROUP;
        if vectors > limit {
            return Err(Error::BadCount { vectors, limit });
        }
        let workgroups = vectors.div_ceil(WORKGROUP) as u32;
        self.dispatch(
            &Dispatch { kernel, workgroups, constants: [vectors as u32, repetitions] },
            input,
            output,
        )
    }

    fn check(&self, kernel: &Kernel, vectors: usize) -> Result<(), Error> {
        if !Arc::ptr_eq(&kernel.layout, &self.layout) {
            return Err(Error::ForeignKernel);
        }
        if vectors == 0 || vectors > self.capacity {
            return Err(Error::BadCount { vectors, limit: self.capacity });
        }
        Ok(())
    }

    fn dispatch(
        &mut self,
        dispatch: &Dispatch<'_>,
        input: &[u8],
        output: &mut [u8],
    ) -> Result<Option<f64>, Error> {
        let size = buffer_size(self.capacity);
        let input = &input[..input.len().min(size)];
        self.input.host_mut().write(input);
        let written = output.len().min(size);
        match dispatch.kernel.buffers {
            Buffers::ExactSize => {
                self.bind(0, &self.input, input.len());
                self.bind(1, &self.output, written);
            }
            // The kernel does not look at their size: they hold the groups of any element, whatever the slices hold.
            Buffers::WholeGroups => {
                self.bind(0, &self.input, size);
                self.bind(1, &self.output, size);
            }
        }
        if let Some(table) = &dispatch.kernel.table {
            self.bind(2, &table.data, table.data.device.size);
        }
        self.record(dispatch, input.len(), written)?;
        self.submit_and_wait()?;
        self.output.host().read(output);
        self.elapsed()
    }

    fn create_commands(&mut self) -> Result<(), Error> {
        let device = &self.device.raw;
        let pool = vk::CommandPoolCreateInfo::default()
            .queue_family_index(self.device.queue_family)
            .flags(vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER);
        let queries = vk::QueryPoolCreateInfo::default().query_type(vk::QueryType::TIMESTAMP).query_count(2);
        // SAFETY: the create infos are valid for this device; what is created is destroyed in `drop`.
        unsafe {
            self.pool = device.create_command_pool(&pool, None).named("vkCreateCommandPool")?;
            let allocate =
                vk::CommandBufferAllocateInfo::default().command_pool(self.pool).command_buffer_count(1);
            self.commands = device.allocate_command_buffers(&allocate).named("vkAllocateCommandBuffers")?[0];
            self.fence = device.create_fence(&vk::FenceCreateInfo::default(), None).named("vkCreateFence")?;
            if self.device.timestamps.is_some() {
                self.queries = device.create_query_pool(&queries, None).named("vkCreateQueryPool")?;
            }
        }
        Ok(())
    }

    fn create_descriptors(&mut self) -> Result<(), Error> {
        let device = &self.device.raw;
        let sizes =
            [vk::DescriptorPoolSize::default().ty(vk::DescriptorType::STORAGE_BUFFER).descriptor_count(3)];
        let pool = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
        let layouts = [self.layout.set];
        // SAFETY: the create infos are valid; the pool has room for the one set.
        unsafe {
            self.descriptors = device.create_descriptor_pool(&pool, None).named("vkCreateDescriptorPool")?;
            let allocate = vk::DescriptorSetAllocateInfo::default()
                .descriptor_pool(self.descriptors)
                .set_layouts(&layouts);
            self.set = device.allocate_descriptor_sets(&allocate).named("vkAllocateDescriptorSets")?[0];
        }
        Ok(())
    }

    /// Binds the first `bytes` bytes of a buffer, and the rest of the last word: what lies beyond does not exist for the
    /// kernel.
    fn bind(&self, binding: u32, buffer: &Staged, bytes: usize) {
        let range = bytes.next_multiple_of(4).max(4) as u64;
        let buffer = [vk::DescriptorBufferInfo::default().buffer(buffer.device.raw).range(range)];
        let write = vk::WriteDescriptorSet::default()
            .dst_set(self.set)
            .dst_binding(binding)
            .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
            .buffer_info(&buffer);
        // SAFETY: the set is not in use, since each submission is waited for. The range lies in the buffer, which has whole
        // words. Input and output live as long as the set; a kernel keeps its table, and other kernels do not read binding 2.
        unsafe { self.device.raw.update_descriptor_sets(&[write], &[]) };
    }

    fn record(&self, dispatch: &Dispatch<'_>, input_bytes: usize, output_bytes: usize) -> Result<(), Error> {
        let device = &self.device.raw;
        let commands = self.commands;
        let &Dispatch { kernel, workgroups, constants } = dispatch;
        let timed = self.queries != vk::QueryPool::null();
        // SAFETY: the command buffer is not in use, since each submission is waited for; all handles are the runner's
        // or the kernel's, of the same device; copies and the dispatch stay within the buffers, whose size is that of
        // `capacity` vectors of the largest element, in whole groups; barriers order each step's memory accesses before the next's.
        unsafe {
            begin(device, commands)?;
            if timed {
                device.cmd_reset_query_pool(commands, self.queries, 0, 2);
            }
            if let Some(staging) = &self.input.staging {
                copy(device, commands, staging, &self.input.device, input_bytes);
            }
            if self.fill_output {
                let words = output_bytes.next_multiple_of(4) as u64;
                device.cmd_fill_buffer(commands, self.output.device.raw, 0, words, SENTINEL);
            }
            barrier(device, commands, Step::Transfer, Step::Compute);
            device.cmd_bind_pipeline(commands, vk::PipelineBindPoint::COMPUTE, kernel.pipeline);
            device.cmd_bind_descriptor_sets(
                commands,
                vk::PipelineBindPoint::COMPUTE,
                self.layout.pipeline,
                0,
                &[self.set],
                &[],
            );
            device.cmd_push_constants(
                commands,
                self.layout.pipeline,
                vk::ShaderStageFlags::COMPUTE,
                0,
                bytemuck::bytes_of(&constants),
            );
            if timed {
                let stage = vk::PipelineStageFlags::COMPUTE_SHADER;
                device.cmd_write_timestamp(commands, stage, self.queries, 0);
                device.cmd_dispatch(commands, workgroups, 1, 1);
                device.cmd_write_timestamp(commands, stage, self.queries, 1);
            } else {
                device.cmd_dispatch(commands, workgroups, 1, 1);
            }
            if let Some(staging) = &self.output.staging {
                barrier(device, commands, Step::Compute, Step::Transfer);
                copy(device, commands, &self.output.device, staging, output_bytes);
                barrier(device, commands, Step::Transfer, Step::Host);
            } else {
                barrier(device, commands, Step::Compute, Step::Host);
            }
            device.end_command_buffer(commands).named("vkEndCommandBuffer")
        }
    }

    fn submit_and_wait(&self) -> Result<(), Error> {
        let device = &self.device.raw;
        let commands = [self.commands];
        let submit = [vk::SubmitInfo::default().command_buffers(&commands)];
        // SAFETY: the command buffer is recorded, the fence unsignalled and both unused by any other submission; the
        // queue is locked for the submission alone, so that other runners may submit while this one waits.
        unsafe {
            {
                let queue = self.device.queue.lock().unwrap_or_else(PoisonError::into_inner);
                device.queue_submit(*queue, &submit, self.fence).named("vkQueueSubmit")?;
            }
            device.wait_for_fences(&[self.fence], true, u64::MAX).named("vkWaitForFences")?;
            device.reset_fences(&[self.fence]).named("vkResetFences")
        }
    }

    fn elapsed(&self) -> Result<Option<f64>, Error> {
        let Some(timestamps) = &self.device.timestamps else { return Ok(None) };
        let mut ticks = [0u64; 2];
        let flags = vk::QueryResultFlags::TYPE_64 | vk::QueryResultFlags::WAIT;
        // SAFETY: both queries were written by the submission that has ended.
        unsafe { self.device.raw.get_query_pool_results(self.queries, 0, &mut ticks, flags) }
            .named("vkGetQueryPoolResults")?;
        Ok(Some(timestamps.elapsed(ticks[0], ticks[1])))
    }
}

impl Drop for Runner {
    fn drop(&mut self) {
        let device = &self.device.raw;
        // SAFETY: all handles are this runner's own (or null, which is ignored). A submission that failed to be waited
        // for may still run: the device is idled first, and if even that fails it is lost and runs nothing.
        unsafe {
            {
                let _queue = self.device.queue.lock().unwrap_or_else(PoisonError::into_inner);
                let _ = device.device_wait_idle();
            }
            device.destroy_query_pool(self.queries, None);
            device.destroy_fence(self.fence, None);
            device.destroy_descriptor_pool(self.descriptors, None);
            device.destroy_command_pool(self.pool, None);
        }
    }
}

impl Layout {
    pub(super) fn new(device: &Arc<Device>) -> Result<Self, Error> {
        let binding = vk::DescriptorSetLayoutBinding::default()
            .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
            .descriptor_count(1)
            .stage_flags(vk::ShaderStageFlags::COMPUTE);
        let bindings = [binding.binding(0), binding.binding(1), binding.binding(2)];
        let create = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        // SAFETY: a valid create info; destroyed in `drop`.
        let set = unsafe { device.raw.create_descriptor_set_layout(&create, None) }
            .named("vkCreateDescriptorSetLayout")?;
        let mut layout = Self { set, pipeline: vk::PipelineLayout::null(), device: device.clone() };

        let sets = [set];
        let constants = [vk::PushConstantRange::default().stage_flags(vk::ShaderStageFlags::COMPUTE).size(8)];
        let create =
            vk::PipelineLayoutCreateInfo::default().set_layouts(&sets).push_constant_ranges(&constants);
        // SAFETY: as above.
        layout.pipeline =
            unsafe { device.raw.create_pipeline_layout(&create, None) }.named("vkCreatePipelineLayout")?;
        Ok(layout)
    }
}

impl Drop for Layout {
    fn drop(&mut self) {
        // SAFETY: kernels and runners keep an Arc to the layout, so nothing uses it; null is ignored.
        unsafe {
            self.device.raw.destroy_pipeline_layout(self.pipeline, None);
            self.device.raw.destroy_descriptor_set_layout(self.set, None);
        }
    }
}

impl Kernel {
    fn new(
        layout: &Arc<Layout>,
        buffers: Buffers,
        spirv: &[u8],
        entry_point: &str,
        table: Option<Table>,
    ) -> Result<Self, Error> {
        let flags = vk::PipelineCreateFlags::empty();
        let pipeline = compile(layout, buffers, spirv, entry_point, flags)?;
        Ok(Self { pipeline, layout: layout.clone(), table, buffers })
    }
}

/// A pipeline for these buffers, of a device that knows the flags.
pub(super) fn compile(
    layout: &Layout,
    buffers: Buffers,
    spirv: &[u8],
    entry_point: &str,
    flags: vk::PipelineCreateFlags,
) -> Result<vk::Pipeline, Error> {
    let (words, name) = spirv::checked(spirv, entry_point)?;
    let device = &layout.device.raw;

    let create = vk::ShaderModuleCreateInfo::default().code(&words);
    // SAFETY: the code is SPIR-V by its magic number; that it is valid is checked where modules are built, and by
    // their hash where they are read.
    let module = unsafe { device.create_shader_module(&create, None) }.named("vkCreateShaderModule")?;
    let data = (buffers as u32).to_ne_bytes();
    let constants = [vk::SpecializationMapEntry::default().constant_id(0).offset(0).size(data.len())];
    let specialization = vk::SpecializationInfo::default().map_entries(&constants).data(&data);
    let stage = vk::PipelineShaderStageCreateInfo::default()
        .stage(vk::ShaderStageFlags::COMPUTE)
        .module(module)
        .name(&name)
        .specialization_info(&specialization);
    let create = [vk::ComputePipelineCreateInfo::default().flags(flags).stage(stage).layout(layout.pipeline)];
    // SAFETY: the module and the layout are of this device, as the extensions of the flags are; the module may go once the
    // pipeline is made.
    let result = unsafe {
        let result = device.create_compute_pipelines(vk::PipelineCache::null(), &create, None);
        device.destroy_shader_module(module, None);
        result
    };
    let pipelines = result.map_err(|(_, result)| Error::Call { call: "vkCreateComputePipelines", result })?;
    Ok(pipelines[0])
}

impl Drop for Kernel {
    fn drop(&mut self) {
        // SAFETY: the pipeline is this kernel's own; every submission that used it was waited for.
        unsafe { self.layout.device.raw.destroy_pipeline(self.pipeline, None) };
    }
}

/// What accesses memory in a step of a submission.
#[derive(Clone, Copy)]
enum Step {
    Transfer,
    Compute,
    Host,
}

impl Step {
    fn stage_and_access(self) -> (vk::PipelineStageFlags, vk::AccessFlags) {
        match self {
            Self::Transfer => (
                vk::PipelineStageFlags::TRANSFER,
                vk::AccessFlags::TRANSFER_READ | vk::AccessFlags::TRANSFER_WRITE,
            ),
            Self::Compute => (
                vk::PipelineStageFlags::COMPUTE_SHADER,
                vk::AccessFlags::SHADER_READ | vk::AccessFlags::SHADER_WRITE,
            ),
            Self::Host => (vk::PipelineStageFlags::HOST, vk::AccessFlags::HOST_READ),
        }
    }
}

/// Begins a command buffer that is submitted once.
///
/// # Safety
/// `commands` is not in use.
unsafe fn begin(device: &ash::Device, commands: vk::CommandBuffer) -> Result<(), Error> {
    let begin = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
    // SAFETY: as the caller promises.
    unsafe { device.begin_command_buffer(commands, &begin) }.named("vkBeginCommandBuffer")
}

/// Records that all memory accesses of `before` come before those of `after`.
///
/// # Safety
/// `commands` is being recorded.
unsafe fn barrier(device: &ash::Device, commands: vk::CommandBuffer, before: Step, after: Step) {
    let ((from, source), (to, destination)) = (before.stage_and_access(), after.stage_and_access());
    let memory = [vk::MemoryBarrier::default().src_access_mask(source).dst_access_mask(destination)];
    // SAFETY: as the caller promises.
    unsafe {
        device.cmd_pipeline_barrier(commands, from, to, vk::DependencyFlags::empty(), &memory, &[], &[]);
    }
}

/// Records a copy of the first `bytes` bytes.
///
/// # Safety
/// `commands` is being recorded; both buffers have at least `bytes` bytes.
unsafe fn copy(device: &ash::Device, commands: vk::CommandBuffer, from: &Buffer, to: &Buffer, bytes: usize) {
    let region = [vk::BufferCopy::default().size(bytes as u64)];
    // SAFETY: as the caller promises.
    unsafe { device.cmd_copy_buffer(commands, from.raw, to.raw, &region) };
}
