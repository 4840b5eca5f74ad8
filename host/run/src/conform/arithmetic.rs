//! A device's rounding of what codecs compute, measured against float64.

use crate::backend::CHUNK;
use crate::{Result, sampling};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::sync::Arc;
use unitvec_manifest::ARITHMETIC;
use unitvec_manifest::modules::Modules;
use unitvec_vulkan::{BufferPromise, Device, Division, Runner};

/// A device's arithmetic. Errors are the greatest found, in units in the last place of the exact result (ULP).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Arithmetic {
    /// Error of `a / b`. Vulkan allows 2.5.
    pub quotient_ulp: f64,
    /// Error of `1 / b`. Vulkan allows 2.5.
    pub reciprocal_ulp: f64,
    /// Error of the square root. Vulkan allows what `1 / inversesqrt(x)` has, some 5.
    pub root_ulp: f64,
    /// Error of 1 over the square root.
    pub inverse_root_ulp: f64,
    /// Error of `a + b`, and of `a b + a` where the product is rounded first.
    pub sum_ulp: f64,
    /// Error of integers as floats.
    pub conversion_ulp: f64,
    /// Products and sums that were rounded once, as one operation, where NoContraction forbids it.
    pub contracted: u64,
    /// Operands for which a quotient, reciprocal, root or inverse root of the exact kernels is not the CPU's.
    pub inexact: u64,
    /// True where the device takes denormals for zero, as operands or as results. No codec depends on it.
    pub flushes_denormals: bool,
}

/// An error of a correctly rounded result, and of the float64 beside it.
const NEAREST: f64 = 0.500_001;

/// The greatest error of a device's `1 / b` and `1 / sqrt(x)`, from which exact kernels start, that they put right, in ULP.
const CORRECTED: f64 = 14.0;

impl Arithmetic {
    /// Measures a device, with the shipped kernel.
    ///
    /// # Errors
    /// A missing module, or a failed Vulkan call.
    pub fn of(device: &Arc<Device>, modules: &Modules) -> Result<Self> {
        let mut runner = Runner::new(device, CHUNK, false)?;
        let module = modules.load(ARITHMETIC)?;
        let mut results = |operands: &[[f32; 2]], division| -> Result<Vec<[f32; 7]>> {
            let kernel = runner.kernel_for(BufferPromise::ExactSize, division, &module, ARITHMETIC, None)?;
            let mut results = vec![[0.0f32; 7]; operands.len()];
            let bytes = bytemuck::cast_slice_mut(results.as_flattened_mut());
            runner.run(&kernel, operands.len(), bytemuck::cast_slice(operands.as_flattened()), bytes)?;
            Ok(results)
        };
        let operands = operands();
        let [of_device, exact] =
            [Division::Device, Division::Exact].map(|division| results(&operands, division));
        let flushes_denormals = flushes(&results(&DENORMALS, Division::Device)?);
        Ok(Self { flushes_denormals, ..Self::measured(&operands, &of_device?, &exact?) })
    }

    fn measured(operands: &[[f32; 2]], of_device: &[[f32; 7]], exact: &[[f32; 7]]) -> Self {
        let mut all = Self::default();
        for ((&[a, b], of_device), exact) in operands.iter().zip(of_device).zip(exact) {
            let on_cpu = [a / b, 1.0 / b, a.sqrt(), 1.0 / a.sqrt()];
            all.inexact += u64::from(on_cpu[..] != exact[..4]);
            let [quotient, reciprocal, root, inverse_root, sum, fused, conversion] = *of_device;
            let (x, y, bits) = (f64::from(a), f64::from(b), f64::from(b.to_bits() as i32));
            let twice = f64::from(a * b) + x;
            let once = (x * y + x) as f32;
            all.contracted += u64::from(fused == once && fused != twice as f32);
            // What was contracted has its own reason.
            let of_product = if fused == once { 0.0 } else { ulp(fused, twice) };
            all.sum_ulp = all.sum_ulp.max(of_product);
            for (greatest, found, exact) in [
                (&mut all.quotient_ulp, quotient, x / y),
                (&mut all.reciprocal_ulp, reciprocal, 1.0 / y),
                (&mut all.root_ulp, root, x.sqrt()),
                (&mut all.inverse_root_ulp, inverse_root, 1.0 / x.sqrt()),
                (&mut all.sum_ulp, sum, x + y),
                (&mut all.conversion_ulp, conversion, bits),
            ] {
                *greatest = greatest.max(ulp(found, exact));
            }
        }
        all
    }

    /// True where the device's own division and roots are rounded as the CPU's: plain functions give the CPU's bits.
    pub fn divides_exactly(&self) -> bool {
        // The inverse of a root is rounded twice, on the CPU as well.
        [self.quotient_ulp, self.reciprocal_ulp, self.root_ulp].iter().all(|ulp| *ulp <= NEAREST)
    }

    /// The reason why no codec can be exact on the device, if there is one.
    pub fn objection(&self) -> Option<String> {
        if self.sum_ulp > NEAREST {
            return Some("the device does not round sums and products to nearest".to_owned());
        }
        if self.contracted > 0 {
            return Some("the device contracts products and sums, where NoContraction forbids it".to_owned());
        }
        if self.conversion_ulp > NEAREST {
            return Some("the device does not round integers to the nearest float".to_owned());
        }
        let far = self.reciprocal_ulp.max(self.inverse_root_ulp);
        let reason = if far > CORRECTED {
            format!(
                "the device's reciprocal or inverse root is {far:.1} ULP off, more than {CORRECTED} that can be put right"
            )
        } else {
            format!("exact kernels differ from the CPU in {} quotients and roots", self.inexact)
        };
        (self.inexact > 0).then_some(reason)
    }
}

impl fmt::Display for Arithmetic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.divides_exactly() {
            return f.write_str("quotients and roots: rounded correctly by the device itself");
        }
        let Self { quotient_ulp, reciprocal_ulp, root_ulp, inverse_root_ulp, .. } = self;
        write!(
            f,
            "quotients: the device's own are within {quotient_ulp:.1} ULP, reciprocals {reciprocal_ulp:.1}, roots {root_ulp:.1}, \
             inverse roots {inverse_root_ulp:.1}"
        )
    }
}

/// The distance of a result from the exact one, in the last place of that; infinite for NaN.
fn ulp(found: f32, exact: f64) -> f64 {
    let place = 2f64.powi((exact.abs().log2().floor() as i32).max(-126) - 23);
    let distance = ((f64::from(found) - exact) / place).abs();
    if distance.is_nan() { f64::INFINITY } else { distance }
}

/// Operands that the kernel takes, whose product is denormal, and one that is; with the other, `a b + a` and `a + b` are normal.
const DENORMALS: [[f32; 2]; 2] = [[f32::MIN_POSITIVE, 0.5], [f32::MIN_POSITIVE / 2.0, f32::MIN_POSITIVE]];

/// True where a denormal is missing in the results of [`DENORMALS`].
fn flushes(results: &[[f32; 7]]) -> bool {
    [results[0][5], results[1][4]] != [1.5 * f32::MIN_POSITIVE; 2]
}

/// Pairs of operands, from 2^-20 to 2^20: random ones, and every second time such that `a / b` lies next to the middle between
/// two floats, or nearly.
fn operands() -> Vec<[f32; 2]> {
    let float = |bits: u32| f32::from_bits((bits & 0x7f_ffff) | ((107 + (bits >> 23) % 41) << 23));
    let pair = |(index, bits): (usize, u64)| {
        let [a, b] = [float(bits as u32), float((bits >> 32) as u32)];
        // The middle above the float next to the quotient, times the divisor, rounded.
        let middle = f64::from(a / b) * (1.0 + 2f64.powi(-24));
        [if index % 2 == 1 { (middle * f64::from(b)) as f32 } else { a }, b]
    };
    sampling::random_codes(1).enumerate().take(CHUNK).map(pair).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The results of a device that moves quotients and roots by so many ULP.
    fn results(operands: &[[f32; 2]], by: i32) -> Vec<[f32; 7]> {
        let moved = |x: f32| f32::from_bits(x.to_bits().wrapping_add_signed(by));
        let of = |&[a, b]: &[f32; 2]| {
            let [quotient, reciprocal] = [a / b, 1.0 / b].map(moved);
            let [root, inverse_root] = [a.sqrt(), 1.0 / a.sqrt()].map(moved);
            [quotient, reciprocal, root, inverse_root, a + b, a * b + a, b.to_bits() as i32 as f32]
        };
        operands.iter().map(of).collect()
    }

    #[test]
    fn what_a_device_does_is_found() {
        let operands = operands();
        let [exact, loose] = [0, 2].map(|by| results(&operands, by));
        let found = Arithmetic::measured(&operands, &exact, &exact);
        assert!(found.divides_exactly() && found.objection().is_none(), "{found:?}");
        let found = Arithmetic::measured(&operands, &loose, &exact);
        assert!(!found.divides_exactly() && found.objection().is_none(), "{found:?}");
        assert!(
            (2.4..=4.6).contains(&found.quotient_ulp) && (2.4..=2.6).contains(&found.root_ulp),
            "{found:?}"
        );
        let found = Arithmetic::measured(&operands, &results(&operands, 20), &loose);
        assert!(found.objection().unwrap().contains("more than 14"), "{found:?}");
        let with_sums = |of_product: &dyn Fn(f32, f32) -> f32| {
            let mut results = exact.clone();
            results.iter_mut().zip(&operands).for_each(|(of, &[a, b])| of[5] = of_product(a, b));
            Arithmetic::measured(&operands, &results, &exact)
        };
        // As `mul_add`, which MinGW's library rounds twice.
        let fused = |a: f32, b: f32| (f64::from(a) * f64::from(b) + f64::from(a)) as f32;
        let found = with_sums(&fused);
        assert!(found.objection().unwrap().contains("NoContraction"), "{found:?}");
        let truncated = |a: f32, b: f32| {
            let product = a * b;
            f32::from_bits(product.to_bits() - u32::from(f64::from(product) > f64::from(a) * f64::from(b)))
        };
        let found = with_sums(&|a, b| truncated(a, b) + a);
        assert!(found.objection().unwrap().contains("sums and products to nearest"), "{found:?}");
        // The CPU keeps denormals; a device may lose those that go in, or those that come out.
        let kept = results(&DENORMALS, 0);
        let [mut goes_in, mut comes_out] = [kept.clone(), kept.clone()];
        (goes_in[1][4], comes_out[0][5]) = (DENORMALS[1][1], DENORMALS[0][0]);
        assert_eq!([kept, goes_in, comes_out].map(|results| flushes(&results)), [false, true, true]);
    }
}
