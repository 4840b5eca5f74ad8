//! The slices of Rust on this machine, for `speed.js`: `slices CODEC COUNT` prints nanoseconds a vector of encoding and decoding on one
//! thread, the least of five.

use std::error::Error;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let [name, count] = &std::env::args().skip(1).collect::<Vec<_>>()[..] else {
        return Err("usage: slices CODEC COUNT".into());
    };
    let (codec, count) = (unitvec_catalogue::find(name)?, count.parse::<usize>()?);
    let mut floats: Vec<f32> =
        (0..count * codec.element.floats()).map(|i| (i as f32 * 0.618_034).fract() - 0.5).collect();
    let mut codes = vec![0; count * codec.bytes];
    let mut least = [f64::INFINITY; 2];
    for _ in 0..5 {
        let started = Instant::now();
        codec.encode_here(&floats, &mut codes)?;
        let encoded = started.elapsed();
        codec.decode_here(&codes, &mut floats)?;
        let times = [encoded, started.elapsed() - encoded];
        for (least, time) in least.iter_mut().zip(times) {
            *least = least.min(time.as_secs_f64() * 1e9 / count as f64);
        }
    }
    println!("{} {}", least[0], least[1]);
    Ok(())
}
