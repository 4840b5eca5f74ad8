//! The end points and indices of BC5 by angle.
//!
//! The error of a block is the sum of its texels' angles to the power 5/4. The power 1 has the least mean by definition, and
//! gives up single texels for it; 5/4 has nearly that mean, and much less of a maximum.
//!
//! For end points alone, no texel's indices concern another's: of the 64 directions the nearest is taken. End points are
//! found channel by channel. By the first fundamental form of the pair's map at a texel, errors du and dv of its coordinates are
//! an angle of
//!
//! ```text
//! angle^2 = E du^2 + 2 F du dv + G dv^2 = E (du + F/E dv)^2 + (G - F^2/E) dv^2
//! ```
//!
//! So the other channel's error dv shifts the coordinate that a texel wants, and adds a part that this channel cannot
//! lower. The channels take turns.

use super::TEXELS;
use super::bc5::{Block, Range};
use crate::Pair;

type Texels = [f32; TEXELS];

/// Turns of each channel after the first. More gain less than a hundredth.
const TURNS: usize = 3;

/// The block of the least error that is found, never worse than `first`.
pub(super) fn best(texels: &[[f32; 3]; TEXELS], pair: Pair, range: Range, first: Block) -> Block {
    let map = Map::new(texels, pair, range);
    let mut best = map.fit(first.ends);
    let alone = [0, 1].map(|channel| map.line(channel, [0.0; TEXELS]).best(first.ends[channel]));
    let mut current = map.fit(alone);
    for turn in 0..2 * TURNS {
        best = best.or_better(current);
        let (channel, points) = (turn % 2, current.block.points(range));
        let off =
            std::array::from_fn(|texel| (points[texel][1 - channel] - map.points[texel][1 - channel]) as f32);
        let mut ends = current.block.ends;
        ends[channel] = map.line(channel, off).descend(ends[channel], 4).1;
        current = map.fit(ends);
    }
    best.or_better(current).block
}

/// An angle of a squared length of its chord, to the power 5/4.
#[inline(always)]
fn error(square: f32) -> f32 {
    let angle = square.sqrt();
    angle * angle.sqrt().sqrt()
}

/// A block and its error.
#[derive(Clone, Copy)]
struct Fit {
    error: f32,
    block: Block,
}

impl Fit {
    fn or_better(self, other: Self) -> Self {
        if other.error < self.error { other } else { self }
    }
}

/// The texels of a block: their points, directions, and E, F and G there.
struct Map {
    points: [[f64; 2]; TEXELS],
    directions: [[f32; 3]; TEXELS],
    forms: [[f32; 3]; TEXELS],
    pair: Pair,
    range: Range,
}

impl Map {
    fn new(texels: &[[f32; 3]; TEXELS], pair: Pair, range: Range) -> Self {
        // The points' own directions: those of the pair's domain, also for texels without any.
        let points = texels.map(|texel| pair.point(texel));
        let directions = points.map(|point| pair.vector(point).map(|t| t as f32));
        Self { points, directions, forms: points.map(|point| form(pair, point)), pair, range }
    }

    /// The block of these end points in which each texel has the nearest direction.
    fn fit(&self, ends: [[i32; 2]; 2]) -> Fit {
        let [u, v] = ends.map(|ends| self.range.palette(ends));
        let mut all = [[0f32; 64]; 3];
        for at in 0..64 {
            let vector = self.pair.vector([u[at / 8], v[at % 8]]);
            for axis in 0..3 {
                all[axis][at] = vector[axis] as f32;
            }
        }
        let mut fit = Fit { error: 0.0, block: Block { ends, indices: [[0; TEXELS]; 2] } };
        for (texel, direction) in self.directions.iter().enumerate() {
            let mut squares = [0f32; 64];
            for axis in 0..3 {
                for (square, component) in squares.iter_mut().zip(all[axis]) {
                    *square += (component - direction[axis]) * (component - direction[axis]);
                }
            }
            let at = (1..64).fold(0, |least, at| if squares[at] < squares[least] { at } else { least });
            fit.error += error(squares[at]);
            fit.block.indices[0][texel] = (at / 8) as u8;
            fit.block.indices[1][texel] = (at % 8) as u8;
        }
        fit
    }

    /// What a channel's end points are to meet, with the other channel this much off.
    fn line(&self, channel: usize, off: Texels) -> Line {
        let mut line = Line { wanted: off, weights: off, rest: off, range: self.range };
        for (texel, off) in off.into_iter().enumerate() {
            let [e, f, g] = self.forms[texel];
            let (own, other) = if channel == 0 { (e, g) } else { (g, e) };
            line.wanted[texel] = self.points[texel][channel] as f32 - f / own * off;
            line.weights[texel] = own;
            line.rest[texel] = (other - f * f / own).max(0.0) * off * off;
        }
        line
    }
}

/// The first fundamental form of a pair's map, by differences over half a step of 8 bits: at creases and on the rim of
/// [`Pair::Xy`] it stays finite.
fn form(pair: Pair, [u, v]: [f64; 2]) -> [f32; 3] {
    const HALF: f64 = 1.0 / 256.0;
    let along = |du: f64, dv: f64| {
        let [to, from] = [pair.vector([u + du, v + dv]), pair.vector([u - du, v - dv])];
        [0, 1, 2].map(|axis| (to[axis] - from[axis]) / (2.0 * HALF))
    };
    let (along_u, along_v) = (along(HALF, 0.0), along(0.0, HALF));
    let dot = |a: [f64; 3], b: [f64; 3]| (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) as f32;
    [dot(along_u, along_u).max(1e-6), dot(along_u, along_v), dot(along_v, along_v).max(1e-6)]
}

/// One channel: the coordinate that each texel wants, the weight of its square, and what the other channel adds.
struct Line {
    wanted: Texels,
    weights: Texels,
    rest: Texels,
    range: Range,
}

impl Line {
    /// The error of the block, were angles what the forms say.
    fn error(&self, ends: [i32; 2]) -> f32 {
        let mut off = [f32::INFINITY; TEXELS];
        for value in self.range.palette(ends) {
            let value = value as f32;
            for (off, wanted) in off.iter_mut().zip(self.wanted) {
                // Not `min`, which minds NaN: compilers make vector instructions of this.
                let distance = (wanted - value).abs();
                *off = if distance < *off { distance } else { *off };
            }
        }
        for ((off, weight), rest) in off.iter_mut().zip(&self.weights).zip(&self.rest) {
            *off = error(weight * *off * *off + rest);
        }
        off.iter().sum()
    }

    /// The best end points of several starts: those given; the extremes of what is wanted, moved inwards and outwards; and,
    /// for 4 values between end points, the extremes in the other order.
    fn best(&self, given: [i32; 2]) -> [i32; 2] {
        let (low, high) = self
            .wanted
            .iter()
            .fold((1f32, -1f32), |(low, high), wanted| (low.min(*wanted), high.max(*wanted)));
        let moved = |part: f32| {
            let inwards = part * (high - low);
            [high - inwards, low + inwards].map(|end| self.range.nearest(f64::from(end)))
        };
        let [most, least] = moved(0.0);
        [[least, most], moved(1.0 / 16.0), moved(1.0 / 8.0), moved(-1.0 / 16.0)]
            .into_iter()
            .map(|start| self.descend(start, (most - least) / 8))
            .fold(
                self.descend(given, (most - least) / 8),
                |best, found| if found.0 < best.0 { found } else { best },
            )
            .1
    }

    /// The error and end points where no step lowers the error: of one end point, of both alike, or apart. Steps begin at
    /// `step` and are halved.
    fn descend(&self, start: [i32; 2], step: i32) -> (f32, [i32; 2]) {
        const MOVES: [[i32; 2]; 8] = [[1, 0], [-1, 0], [0, 1], [0, -1], [1, 1], [-1, -1], [1, -1], [-1, 1]];
        let (mut best, mut step) = ((self.error(start), start), step.max(1));
        while step > 0 {
            let before = best.0;
            for by in MOVES {
                let ends = [0, 1].map(|end| self.range.clamp(best.1[end] + step * by[end]));
                let error = self.error(ends);
                best = if error < best.0 { (error, ends) } else { best };
            }
            step = if best.0 < before { step } else { step / 2 };
        }
        best
    }
}
