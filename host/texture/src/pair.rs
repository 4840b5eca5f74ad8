//! Directions in two channels.

/// What two channels hold of a direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pair {
    /// x and y of a direction of the hemisphere z >= 0.
    Xy,
    /// Hemi-oct: the hemisphere z >= 0 on a square (Cigolle et al. 2014, listing 3).
    Hemioct,
    /// Oct: the whole sphere on a square (Cigolle et al. 2014, listing 2).
    Oct,
}
