//! Codecs on several threads, so that one codec's kernels are compiled and run while another's results are compared.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError, mpsc};
use std::{iter, thread, vec};

/// Maximum number of threads: each has 112 MiB of buffers of its own on the device, and as much for staging.
const MAX_THREADS: usize = 4;

enum Message<Row, Error> {
    /// The amount of work done since the last message.
    Done(u64),
    /// The plan of this index is done.
    Row(usize, Result<Box<Row>, Error>),
    /// The thread could not open its backends.
    Failed(Error),
}

/// Plans that no thread has begun, by index.
type Queue<Plan> = Mutex<iter::Enumerate<vec::IntoIter<Plan>>>;

/// Runs all plans. `open` opens the backends of a thread, which `work` runs a plan with; `progress` receives the work
/// done since the last call, and `each` the rows, in the plans' order.
///
/// # Errors
/// The first error of a thread or of `each`.
pub fn run<Plan: Send, Backends, Row: Send, Error: Send>(
    plans: Vec<Plan>,
    open: impl Fn() -> Result<Backends, Error> + Sync,
    work: impl Fn(Plan, &mut Backends, &mut dyn FnMut(u64)) -> Result<Row, Error> + Sync,
    progress: &mut dyn FnMut(u64),
    each: &mut dyn FnMut(Row) -> Result<(), Error>,
) -> Result<(), Error> {
    let threads = thread::available_parallelism().map_or(1, |count| count.get()).min(MAX_THREADS);
    let threads = threads.min(plans.len());
    let queue = Mutex::new(plans.into_iter().enumerate());
    let (sender, receiver) = mpsc::channel();
    thread::scope(|scope| {
        for _ in 0..threads {
            let sender = sender.clone();
            scope.spawn(|| run_plans(&queue, &open, &work, sender));
        }
        drop(sender);
        let result = collect(receiver, progress, each);
        // Threads begin no plan after an error.
        while next(&queue).is_some() {}
        result
    })
}

fn next<Plan>(queue: &Queue<Plan>) -> Option<(usize, Plan)> {
    queue.lock().unwrap_or_else(PoisonError::into_inner).next()
}

/// The loop of a thread: one plan after the other, whichever is next.
fn run_plans<Plan, Backends, Row, Error>(
    queue: &Queue<Plan>,
    open: &impl Fn() -> Result<Backends, Error>,
    work: &impl Fn(Plan, &mut Backends, &mut dyn FnMut(u64)) -> Result<Row, Error>,
    sender: mpsc::Sender<Message<Row, Error>>,
) {
    // Sending fails where an error has ended the run and the receiver is gone: then nobody wants to know.
    let mut backends = match open() {
        Ok(backends) => backends,
        Err(error) => {
            let _ = sender.send(Message::Failed(error));
            return;
        }
    };
    while let Some((index, plan)) = next(queue) {
        let mut progress = |done| drop(sender.send(Message::Done(done)));
        let row = work(plan, &mut backends, &mut progress);
        let _ = sender.send(Message::Row(index, row.map(Box::new)));
    }
}

/// Hands rows on in their order, until the threads have ended or one has met an error.
fn collect<Row, Error>(
    receiver: mpsc::Receiver<Message<Row, Error>>,
    progress: &mut dyn FnMut(u64),
    each: &mut dyn FnMut(Row) -> Result<(), Error>,
) -> Result<(), Error> {
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
