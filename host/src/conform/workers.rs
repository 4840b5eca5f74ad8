//! Codecs on several threads, so that one codec's kernels are compiled and run while another's results are compared.

use super::{Gpus, Options, Row, frame_work, run_codec, run_frame, work};
use crate::catalogue::{CodecInfo, FrameInfo};
use crate::{Error, Result};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

/// Maximum number of threads: each has 112 MiB of buffers of its own on the device, and as much for staging.
const MAX_THREADS: usize = 4;

/// What is run.
#[derive(Clone, Copy)]
pub enum Subject {
    /// A codec of vectors.
    Codec(&'static CodecInfo),
    /// A codec of tangent frames.
    Frame(&'static FrameInfo),
}

impl Subject {
    /// Its identifier.
    pub fn id(self) -> &'static str {
        match self {
            Self::Codec(codec) => codec.id,
            Self::Frame(codec) => codec.id,
        }
    }

    /// Vectors or frames, and codes, that are passed through each backend: for progress.
    pub fn work(self, options: &Options) -> u64 {
        match self {
            Self::Codec(codec) => work(codec, options),
            Self::Frame(_) => frame_work(options),
        }
    }

    fn run(self, options: &Options, gpus: &mut Gpus, progress: &mut dyn FnMut(u64)) -> Result<Row> {
        match self {
            Self::Codec(codec) => run_codec(codec, options, gpus, progress),
            Self::Frame(codec) => run_frame(codec, options, gpus, progress),
        }
    }
}

/// What a thread tells.
enum Message {
    /// So much work more is done.
    Done(u64),
    /// The subject of this index is done.
    Row(usize, Result<Box<Row>>),
    /// The thread could not open its backends.
    Failed(Error),
}

/// Runs all subjects. `open` opens the backends of a thread; `progress` is told the work done since it was last called,
/// and `each` the rows, in the subjects' order.
///
/// # Errors
/// The first error of a thread or of `each`. Mismatches are no error: they are in the rows.
pub fn run(
    subjects: &[Subject],
    options: &Options,
    open: impl Fn() -> Result<Gpus> + Sync,
    progress: &mut dyn FnMut(u64),
    each: &mut dyn FnMut(Row) -> Result<()>,
) -> Result<()> {
    let next = AtomicUsize::new(0);
    let threads = thread::available_parallelism().map_or(1, |count| count.get()).min(MAX_THREADS);
    let (sender, receiver) = mpsc::channel();
    thread::scope(|scope| {
        for _ in 0..threads.min(subjects.len()) {
            let sender = sender.clone();
            scope.spawn(|| work_off(subjects, options, &open, &next, sender));
        }
        drop(sender);
        let result = collect(receiver, progress, each);
        // After an error no thread begins another subject.
        next.store(subjects.len(), Ordering::Relaxed);
        result
    })
}

/// What a thread does: one subject after the other, whichever is next.
fn work_off(
    subjects: &[Subject],
    options: &Options,
    open: &impl Fn() -> Result<Gpus>,
    next: &AtomicUsize,
    sender: mpsc::Sender<Message>,
) {
    // Sending fails where an error has ended the run and the receiver is gone: then nobody wants to know.
    let mut gpus = match open() {
        Ok(gpus) => gpus,
        Err(error) => {
            let _ = sender.send(Message::Failed(error));
            return;
        }
    };
    loop {
        let index = next.fetch_add(1, Ordering::Relaxed);
        let Some(subject) = subjects.get(index) else { return };
        let mut progress = |done| drop(sender.send(Message::Done(done)));
        let row = subject.run(options, &mut gpus, &mut progress);
        let _ = sender.send(Message::Row(index, row.map(Box::new)));
    }
}

/// Hands rows on in their order, until the threads have ended or one has met an error.
fn collect(
    receiver: mpsc::Receiver<Message>,
    progress: &mut dyn FnMut(u64),
    each: &mut dyn FnMut(Row) -> Result<()>,
) -> Result<()> {
    let mut waiting = BTreeMap::new();
    let mut first = 0;
    for message in receiver {
        match message {
            Message::Done(work) => progress(work),
            Message::Failed(error) => return Err(error),
            Message::Row(index, row) => {
                waiting.insert(index, row?);
                while let Some(row) = waiting.remove(&first) {
                    first += 1;
                    each(*row)?;
                }
            }
        }
    }
    Ok(())
}
