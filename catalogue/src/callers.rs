//! Needs of callers from other languages: doubles, and processes that fork.

use crate::has_direction;
use std::process;
use std::sync::atomic::{AtomicU32, Ordering};

/// Rounds elements of doubles, three components or four of a rotation at a time, to floats: parts of `part` numbers. A part
/// whose direction floats would not hold is divided by its largest component first.
///
/// ```
/// let mut floats = [0.0; 3];
/// unitvec_catalogue::round(&[1e300, 0.0, -1e300], &mut floats, 3);
/// assert_eq!(floats, [1.0, 0.0, -1.0]);
/// ```
pub fn round(doubles: &[f64], floats: &mut [f32], part: usize) {
    floats.iter_mut().zip(doubles).for_each(|(to, from)| *to = *from as f32);
    for (from, to) in doubles.chunks(part).zip(floats.chunks_mut(part)).filter(|(_, to)| !has_direction(to)) {
        let largest = from.iter().fold(0.0, |largest: f64, component| largest.max(component.abs()));
        if largest > 0.0 && largest.is_finite() {
            to.iter_mut().zip(from).for_each(|(to, from)| *to = (from / largest) as f32);
        }
    }
}

/// True in the process whose first question this is. A caller that asks before each parallel call learns so whether the
/// threads are there: the first call starts them, a process that was forked after it has none, and would wait for ever.
pub fn has_threads() -> bool {
    static STARTED_IN: AtomicU32 = AtomicU32::new(0);
    // Only Unix forks, and not every other system has numbers for processes.
    let own = if cfg!(unix) { process::id() } else { 1 };
    let before = STARTED_IN.compare_exchange(0, own, Ordering::Relaxed, Ordering::Relaxed);
    before.map_or_else(|process| process == own, |_| true)
}
