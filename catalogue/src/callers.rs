//! Needs of callers from other languages: doubles, and processes that fork.

use crate::{Element, has_direction};
use std::process;
use std::sync::atomic::{AtomicU32, Ordering};

impl Element {
    /// Rounds elements of doubles to floats. A part whose direction floats would not hold is divided by its largest component
    /// first.
    ///
    /// ```
    /// let mut floats = [0.0; 3];
    /// unitvec_catalogue::Element::Vector.round(&[1e300, 0.0, -1e300], &mut floats);
    /// assert_eq!(floats, [1.0, 0.0, -1.0]);
    /// ```
    pub fn round(self, doubles: &[f64], floats: &mut [f32]) {
        // Handedness, the last number of frames, is a part by itself.
        for (from, to) in doubles.chunks(self.floats()).zip(floats.chunks_mut(self.floats())) {
            from.chunks(self.part_floats()).zip(to.chunks_mut(self.part_floats())).for_each(round_part);
        }
    }
}

fn round_part((from, to): (&[f64], &mut [f32])) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to = *from as f32);
    if has_direction(to) {
        return;
    }
    let largest = from.iter().fold(0.0, |largest: f64, component| largest.max(component.abs()));
    if largest > 0.0 && largest.is_finite() {
        to.iter_mut().zip(from).for_each(|(to, from)| *to = (from / largest) as f32);
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
