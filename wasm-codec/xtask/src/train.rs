//! Trains the organised codec's tables: counts symbols over synthetic frames, groups the frames into as many sets as
//! there are (each frame joins the set that codes it best), and writes the frequencies.

use farpoint_organised_codec::contexts::{COLOUR_CONTEXTS, GEOMETRY_CONTEXTS, INDEX_CONTEXTS, SYMBOLS};
use farpoint_organised_codec::tables::{COLOUR_SETS, EVEN, GEOMETRY_SETS, normalise};
use farpoint_organised_codec::tile::Pattern;
use farpoint_organised_codec::{
    ColourMode, Encoder, Histogram, Intrinsics, Point, Settings, Source, StreamHeader, stream,
};

use crate::scenes::{Random, Sensor, frame};

/// Frames to train on.
const FRAMES: u64 = 96;
const ROUNDS: usize = 25;

/// Trains and returns the file's bytes.
pub fn train(seed: u64) -> Vec<u8> {
    let mut geometry_samples = Vec::new();
    let mut colour_samples = Vec::new();
    for index in 0..FRAMES {
        let mut random = Random::new(seed.wrapping_add(index * 7919 + 1));
        let sensor = sensor(&mut random);
        let points = frame(seed ^ (index + 1) << 20, &sensor);
        let levels: &[u8] = if index % 4 == 0 { &[2, 3, 4, 5, 6] } else { &[3, 4, 5] };
        for &level in levels {
            let patterns: &[u8] = if level == 3 { &[0, 1, 2] } else { &[0] };
            for &pattern in patterns {
                let settings = Settings { depth_level: level, mode: ColourMode::None, ..Settings::default() };
                geometry_samples.push(count(&points, &sensor, &settings, pattern).0);
            }
        }
        for quality in [6, 9, 12, 15, 18, 21, 24] {
            let mode = if quality < 13 { ColourMode::Full } else { ColourMode::Subsampled };
            let pattern = if quality == 18 { 1 + (index % 5) as u8 } else { 0 };
            let settings = Settings { quality, mode, ..Settings::default() };
            colour_samples.push(count(&points, &sensor, &settings, pattern).1);
        }
        // Pictures of one channel, by a palette of greys; half of them lit by a projector's random dots.
        let mut grey = points.clone();
        let mut dots = 0.0;
        for point in &mut grey {
            dots = 0.6 * dots + 0.4 * random.normal();
            let light = if index % 2 == 0 { (1.0 + 1.6 * dots).clamp(0.1, 3.0) } else { 1.0 };
            let level = (((point[3].to_bits() >> 8 & 255) as f32 * light) as u32).min(255);
            point[3] = f32::from_bits((level * 0x01_0101) | 0xff00_0000);
        }
        let settings = Settings { mode: ColourMode::Palette, ..Settings::default() };
        colour_samples.push(count(&grey, &sensor, &settings, 0).1);
        eprintln!("frame {} of {FRAMES}", index + 1);
    }
    let mut frequencies = cluster("geometry", &geometry_samples, GEOMETRY_SETS, GEOMETRY_CONTEXTS);
    frequencies.extend(cluster("colour", &colour_samples, COLOUR_SETS, COLOUR_CONTEXTS));
    frequencies.iter().flat_map(|frequency| frequency.to_le_bytes()).collect()
}

fn sensor(random: &mut Random) -> Sensor {
    let wide = random.uniform() < 0.4;
    let (width, height, focal) =
        if wide { (480, 480, 240.0) } else { (640, 480, random.between(500.0, 950.0)) };
    let kind = (random.uniform() * 4.0) as u32;
    let lattice = match kind {
        // No matcher's steps to be seen.
        0 => 0.0,
        // Structured light: eighths of a pixel.
        1 | 2 => random.between(0.0025, 0.0036),
        _ => random.between(0.0005, 0.006),
    };
    let noise = random.uniform().powi(2) * 0.0025;
    let share = random.uniform();
    Sensor {
        width,
        height,
        focal,
        lattice,
        white: noise * share,
        smooth: noise * (1.0 - share) + lattice * random.between(0.0, 0.4),
        millimetres: kind < 3 && random.uniform() < 0.7,
        speckle: random.uniform().powi(3) * 0.03,
        colour_noise: random.uniform() * 7.0,
        blur: random.uniform() * 0.6,
    }
}

type Counts = Vec<u32>;

fn count(points: &[Point], sensor: &Sensor, settings: &Settings, pattern: u8) -> (Counts, Counts) {
    let (width, height) = (sensor.width, sensor.height);
    let intrinsics = Intrinsics {
        fx: sensor.focal,
        fy: sensor.focal,
        cx: (width as f32 - 1.0) / 2.0,
        cy: (height as f32 - 1.0) / 2.0,
    };
    let header = StreamHeader {
        id: 0,
        width: width as u16,
        height: height as u16,
        intrinsics,
        depth_unit: stream::DEPTH_UNIT,
        palette: (0..=255).map(|level| [level; 3]).collect(),
        index_frequencies: vec![EVEN; INDEX_CONTEXTS],
    };
    let mut encoder = Encoder::new(header).expect("a camera");
    encoder.patterns().fill(Pattern(pattern));
    let mut histogram = Histogram::default();
    encoder.count(Source::Points(points), settings, 12, 1, &mut histogram);
    let colour = histogram.counts.split_off(GEOMETRY_CONTEXTS * SYMBOLS);
    (histogram.counts, colour)
}

/// k-means with coding cost as the distance.
fn cluster(name: &str, samples: &[Counts], sets: usize, contexts: usize) -> Vec<u16> {
    let mut all = vec![0.0; contexts * SYMBOLS];
    for sample in samples {
        for (sum, count) in all.iter_mut().zip(sample) {
            *sum += f64::from(*count);
        }
    }
    // Begin with samples sorted by bits a symbol under the common table, in equal parts.
    let common = shares(&all, &all);
    let mut order: Vec<usize> = (0..samples.len()).collect();
    let per_symbol =
        |sample: &Counts| cost(sample, &common) / sample.iter().map(|c| f64::from(*c)).sum::<f64>();
    order.sort_by(|a, b| per_symbol(&samples[*a]).total_cmp(&per_symbol(&samples[*b])));
    let mut member = vec![0; samples.len()];
    for (rank, sample) in order.iter().enumerate() {
        member[*sample] = rank * sets / samples.len();
    }
    let mut tables: Vec<Vec<f64>> = Vec::new();
    for round in 0..ROUNDS {
        tables = (0..sets)
            .map(|set| {
                let mut sums = vec![0.0; contexts * SYMBOLS];
                for (sample, own) in samples.iter().zip(&member) {
                    if *own == set {
                        // Each frame has one vote, whatever its size.
                        let total: f64 = sample.iter().map(|c| f64::from(*c)).sum::<f64>().max(1.0);
                        for (sum, count) in sums.iter_mut().zip(sample) {
                            *sum += f64::from(*count) * 3e5 / total;
                        }
                    }
                }
                shares(&sums, &all)
            })
            .collect();
        let mut total = 0.0;
        let mut moved = 0;
        for (sample, own) in samples.iter().zip(&mut member) {
            let (best, bits) = (0..sets)
                .map(|set| (set, cost(sample, &tables[set])))
                .min_by(|a, b| a.1.total_cmp(&b.1))
                .expect("sets");
            moved += usize::from(best != *own);
            *own = best;
            total += bits;
        }
        if round % 4 == 3 || moved == 0 {
            eprintln!("{name} round {round}: {:.4} Mbit, {moved} of {} moved", total / 1e6, samples.len());
        }
        if moved == 0 {
            break;
        }
    }
    tables.concat().as_chunks::<SYMBOLS>().0.iter().flat_map(normalise).collect()
}

/// Of a set, each context's adding up to 1; what it never saw is taken from all sets.
fn shares(sums: &[f64], all: &[f64]) -> Vec<f64> {
    let (own, _) = sums.as_chunks::<SYMBOLS>();
    let (common, _) = all.as_chunks::<SYMBOLS>();
    own.iter()
        .zip(common)
        .flat_map(|(own, common)| {
            let total: f64 = common.iter().sum::<f64>().max(1.0);
            let mixed: [f64; SYMBOLS] = core::array::from_fn(|i| own[i] + 60.0 * common[i] / total + 0.02);
            let sum: f64 = mixed.iter().sum();
            mixed.map(|count| count / sum)
        })
        .collect()
}

fn cost(sample: &Counts, table: &[f64]) -> f64 {
    sample.iter().zip(table).map(|(count, share)| f64::from(*count) * -share.log2()).sum()
}
