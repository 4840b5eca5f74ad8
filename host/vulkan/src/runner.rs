//! The running of kernels: staging, dispatches and tables.

use super::buffer::Buffer;
use super::handle::Handle;
use super::kernel::MAX_ELEMENT;
use super::layout::{Descriptors, Layout};
use super::memory::Place;
use super::submission::{ALL, Submission, barrier};
use super::{BufferPromise, Device, Division, Error, GROUP, Kernel, Named, WORKGROUP};
use ash::vk;
use std::rc::Rc;
use std::sync::Arc;

/// The word that output buffers are filled with before a run, so that output which a kernel fails to write stands out: NaN
/// as a component, and a code that none of the tests' inputs gives throughout.
pub const SENTINEL: u32 = 0x7fc0_dead;

/// A runner of kernels on a device, with two buffers, in and out, staged where the host does not see the device's memory.
pub struct Runner {
    device: Arc<Device>,
    layout: Arc<Layout>,
    input: Staged,
    output: Staged,
    submission: Submission,
    descriptors: Descriptors,
    /// Two timestamps, where the device has them.
    queries: Option<Handle<vk::QueryPool>>,
    capacity: usize,
    fill_output: bool,
}

impl Runner {
    /// A runner for up to `capacity` vectors at a time. With `fill_output`, output memory is overwritten before each
    /// run, so that output which a kernel fails to write cannot pass for its result.
    ///
    /// # Errors
    /// [`Error::BadCount`] for a capacity of 0 or beyond the device's limits, or a failed call.
    pub fn new(device: &Arc<Device>, capacity: usize, fill_output: bool) -> Result<Self, Error> {
        if capacity == 0 || capacity > device.max_vectors {
            return Err(Error::BadCount { vectors: capacity, limit: device.max_vectors });
        }
        let size = buffer_size(capacity);
        let layout = Arc::new(Layout::of_kernels(device)?);
        let create = vk::QueryPoolCreateInfo::default().query_type(vk::QueryType::TIMESTAMP).query_count(2);
        // SAFETY: a valid create info; each submission is waited for.
        let pool = |_: &_| unsafe {
            let created = device.raw.create_query_pool(&create, None);
            Handle::new(device, created, "vkCreateQueryPool", ash::Device::destroy_query_pool)
        };
        Ok(Self {
            device: device.clone(),
            input: Staged::new(device, size)?,
            output: Staged::new(device, size)?,
            submission: Submission::new(device)?,
            descriptors: Descriptors::new(&layout)?,
            layout,
            queries: device.timestamps.as_ref().map(pool).transpose()?,
            capacity,
            fill_output,
        })
    }

    /// The most vectors that [`run`](Self::run) takes.
    pub fn capacity(&self) -> usize {
        self.capacity
    }

    /// The device that kernels run on.
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
        self.kernel_for(BufferPromise::ExactSize, Division::Exact, spirv, entry_point, table)
    }

    /// Makes a kernel as [`kernel`](Self::kernel) does, for buffers that keep this promise, and with this division. A
    /// module without a specialization constant is the same for all of its values.
    ///
    /// # Errors
    /// The errors of [`kernel`](Self::kernel).
    pub fn kernel_for(
        &self,
        promise: BufferPromise,
        division: Division,
        spirv: &[u8],
        entry_point: &str,
        table: Option<&Table>,
    ) -> Result<Kernel, Error> {
        if table.is_some_and(|table| !Arc::ptr_eq(&table.layout, &self.layout)) {
            return Err(Error::ForeignKernel);
        }
        let pipeline =
            self.layout.compile((promise, division), spirv, entry_point, vk::PipelineCreateFlags::empty())?;
        Ok(Kernel { pipeline, layout: self.layout.clone(), table: table.cloned(), promise })
    }

    /// Puts a table on the device.
    ///
    /// # Errors
    /// [`Error::BadCount`] for a table that is empty or exceeds the device's limits, or a failed call.
    pub fn table(&mut self, bytes: &[u8]) -> Result<Table, Error> {
        let limit = self.device.max_vectors * MAX_ELEMENT;
        if bytes.is_empty() || bytes.len() > limit {
            return Err(Error::BadCount {
                vectors: bytes.len() / MAX_ELEMENT,
                limit: self.device.max_vectors,
            });
        }
        let mut data = Staged::new(&self.device, bytes.len())?;
        data.host().write(bytes);
        if let Some(staging) = &data.staging {
            let copy = |device: &_, commands| {
                // SAFETY: the command buffer is being recorded; both buffers have the table's size.
                unsafe { staging.copy_to(device, commands, &data.device, bytes.len()) };
            };
            // SAFETY: the copy is valid, and both buffers live until it was waited for.
            unsafe { self.submission.run(copy)? };
        }
        Ok(Table { data: Rc::new(data.device), layout: self.layout.clone() })
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

    /// Runs a cost kernel as [`run`](Self::run) does: of one vector an invocation, `repetitions` times each.
    ///
    /// # Errors
    /// The errors of [`run`](Self::run).
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
        self.input.host().write(input);
        let written = output.len().min(size);
        let set = self.bind(dispatch.kernel, input.len(), written)?;
        let queries = self.queries.as_deref().copied();
        // SAFETY: all handles are the runner's or the kernel's, of the same device; copies and the dispatch stay within the
        // buffers, whose size is that of `capacity` vectors of the largest element, in whole groups; barriers order each
        // step's memory accesses before the next's.
        unsafe {
            self.submission.run(|device, commands| {
                if let Some(queries) = queries {
                    device.cmd_reset_query_pool(commands, queries, 0, 2);
                }
                if let Some(staging) = &self.input.staging {
                    staging.copy_to(device, commands, &self.input.device, input.len());
                }
                if self.fill_output {
                    let words = written.next_multiple_of(4) as u64;
                    device.cmd_fill_buffer(commands, *self.output.device.raw, 0, words, SENTINEL);
                }
                barrier(device, commands, ALL);
                dispatch.record(device, commands, set, queries);
                if let Some(staging) = &self.output.staging {
                    barrier(device, commands, ALL);
                    self.output.device.copy_to(device, commands, staging, written);
                }
            })?;
        }
        self.output.host().read(output);
        self.elapsed()
    }

    /// A set of the buffers, of which the kernel sees as much as its promise allows.
    fn bind(&mut self, kernel: &Kernel, input: usize, output: usize) -> Result<vk::DescriptorSet, Error> {
        let [input, output] = match kernel.promise {
            BufferPromise::ExactSize => [input, output],
            // The kernel does not look at their size: they hold the groups of any element, whatever the slices hold.
            BufferPromise::WholeGroups => [buffer_size(self.capacity); 2],
        };
        let table = kernel.table.iter().map(|table| (&*table.data, table.data.size));
        // SAFETY: the set is not in use, since each submission is waited for.
        let set = unsafe { self.descriptors.renew()? };
        let buffers = [(&self.input.device, input), (&self.output.device, output)];
        for ((buffer, bytes), binding) in buffers.into_iter().chain(table).zip(0..) {
            // The rest of the last word is bound as well. Anything beyond does not exist for the kernel.
            let range = bytes.next_multiple_of(4).max(4) as u64;
            let buffer = [vk::DescriptorBufferInfo::default().buffer(*buffer.raw).range(range)];
            let write = vk::WriteDescriptorSet::default()
                .dst_set(set)
                .dst_binding(binding)
                .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                .buffer_info(&buffer);
            // SAFETY: the set is new. The range lies in the buffer, which has whole words. Input and output live as long as the
            // runner; a kernel keeps its table, and other kernels do not read binding 2.
            unsafe { self.device.raw.update_descriptor_sets(&[write], &[]) };
        }
        Ok(set)
    }

    fn elapsed(&self) -> Result<Option<f64>, Error> {
        let (Some(timestamps), Some(queries)) = (&self.device.timestamps, &self.queries) else {
            return Ok(None);
        };
        let mut ticks = [0u64; 2];
        let flags = vk::QueryResultFlags::TYPE_64 | vk::QueryResultFlags::WAIT;
        // SAFETY: both queries were written by the submission that has ended.
        unsafe { self.device.raw.get_query_pool_results(**queries, 0, &mut ticks, flags) }
            .named("vkGetQueryPoolResults")?;
        Ok(Some(timestamps.elapsed(ticks[0], ticks[1])))
    }
}

/// One dispatch of a kernel.
struct Dispatch<'a> {
    kernel: &'a Kernel,
    workgroups: u32,
    constants: [u32; 2],
}

impl Dispatch<'_> {
    /// Records the dispatch, between two timestamps where there are `queries`.
    ///
    /// # Safety
    /// `commands` is being recorded, `set` has the buffers that the kernel uses, and all handles are of one device.
    unsafe fn record(
        &self,
        device: &ash::Device,
        commands: vk::CommandBuffer,
        set: vk::DescriptorSet,
        queries: Option<vk::QueryPool>,
    ) {
        let (compute, layout) = (vk::PipelineBindPoint::COMPUTE, *self.kernel.layout.pipeline);
        let constants = bytemuck::bytes_of(&self.constants);
        let timestamp = |query| {
            if let Some(queries) = queries {
                let stage = vk::PipelineStageFlags::COMPUTE_SHADER;
                // SAFETY: as the caller promises; the pool has two queries.
                unsafe { device.cmd_write_timestamp(commands, stage, queries, query) };
            }
        };
        // SAFETY: as the caller promises; the kernel has this layout.
        unsafe {
            device.cmd_bind_pipeline(commands, compute, *self.kernel.pipeline);
            device.cmd_bind_descriptor_sets(commands, compute, layout, 0, &[set], &[]);
            device.cmd_push_constants(commands, layout, vk::ShaderStageFlags::COMPUTE, 0, constants);
            timestamp(0);
            device.cmd_dispatch(commands, self.workgroups, 1, 1);
            timestamp(1);
        }
    }
}

/// Constant data on a device, for kernels to look things up in.
#[derive(Clone)]
pub struct Table {
    data: Rc<Buffer>,
    layout: Arc<Layout>,
}

/// Bytes that hold whole groups of any element.
fn buffer_size(vectors: usize) -> usize {
    vectors.next_multiple_of(GROUP) * MAX_ELEMENT
}

/// A device buffer and, where the host does not see it, its staging buffer.
struct Staged {
    device: Buffer,
    staging: Option<Buffer>,
}

impl Staged {
    fn new(device: &Arc<Device>, size: usize) -> Result<Self, Error> {
        let buffer = Buffer::new(device, size, Place::Device)?;
        let staging =
            if buffer.memory.is_unified() { None } else { Some(Buffer::new(device, size, Place::Host)?) };
        Ok(Self { device: buffer, staging })
    }

    /// The buffer that the host sees.
    fn host(&mut self) -> &mut Buffer {
        self.staging.as_mut().unwrap_or(&mut self.device)
    }
}
