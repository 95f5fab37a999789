//! `cargo bench --bench sampler -- --points 230400 --n 30000`: milliseconds that the sampler takes natively, as one line
//! of JSON. The scene is a room's depths with one point in twenty missing; `pnpm bench sampler` runs it.

use std::time::Instant;

use farpoint_point_codec::{Point, Sampler, SamplingParameters};

fn option(name: &str, default: usize) -> usize {
    let mut arguments = std::env::args();
    while let Some(argument) = arguments.next() {
        if argument == name {
            return arguments.next().and_then(|value| value.parse().ok()).unwrap_or(default);
        }
    }
    default
}

fn main() {
    let points = option("--points", 230_400);
    let count = option("--n", 30_000);
    let rounds = option("--rounds", 300);
    let mut state = 1_u32;
    let mut uniform = || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        (f64::from(state) / f64::from(u32::MAX)) as f32
    };
    let frame: Vec<Point> = (0..points)
        .map(|_| {
            let z = if uniform() < 0.05 { f32::NAN } else { 0.5 + 12.0 * uniform() };
            [(uniform() - 0.5) * 10.0, (uniform() - 0.5) * 10.0, z, 0.0]
        })
        .collect();
    let mut sampler = Sampler::new(points);
    let mut times = Vec::with_capacity(rounds);
    for round in 0..rounds + 20 {
        let begin = Instant::now();
        let parameters = SamplingParameters { count, seed: round as u64, ..SamplingParameters::default() };
        sampler.sample(&frame, &parameters).expect("parameters are in range");
        if round >= 20 {
            times.push(begin.elapsed().as_secs_f64() * 1e3);
        }
    }
    times.sort_by(f64::total_cmp);
    let at = |fraction: f64| times[((times.len() - 1) as f64 * fraction).round() as usize];
    println!(r#"{{"p50":{:.4},"p95":{:.4},"p99":{:.4},"max":{:.4}}}"#, at(0.50), at(0.95), at(0.99), at(1.0));
}
