//! Synthetic scenes to train on: ground, boxes and poles under a spinning sensor, a depth camera, or several merged views.

use farpoint_unorganised_codec::Point;

/// SplitMix64 (Steele, Lea and Flood 2014).
pub struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Near enough to a normal deviate: the sum of twelve.
    pub fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform(0.0, 1.0)).sum::<f64>() - 6.0
    }

    pub fn pick<T: Copy>(&mut self, values: &[T]) -> T {
        values[self.next() as usize % values.len()]
    }
}

#[derive(Clone, Copy)]
struct Surface {
    /// Share of the light that comes back, and how it varies from place to place.
    reflectivity: f64,
    grain: f64,
    colour: [f64; 3],
}

enum Shape {
    Box { centre: [f64; 3], half: [f64; 3], cos: f64, sin: f64 },
    Pole { centre: [f64; 2], radius: f64, top: f64 },
}

pub struct Scene {
    shapes: Vec<(Shape, Surface)>,
    ground: Surface,
    tilt: [f64; 2],
    roughness: f64,
    height: f64,
}

struct Hit {
    range: f64,
    /// Cosine of the angle to the normal.
    facing: f64,
    surface: Surface,
}

fn surface(random: &mut Random) -> Surface {
    Surface {
        reflectivity: random.uniform(0.02, 0.8),
        grain: random.pick(&[0.05, 0.15, 0.4, 0.7]),
        colour: std::array::from_fn(|_| random.uniform(20.0, 235.0)),
    }
}

impl Scene {
    /// A street, or for small sizes a room.
    pub fn new(random: &mut Random, size: f64) -> Self {
        let shapes = (0..40)
            .map(|_| {
                let angle = random.uniform(0.0, std::f64::consts::TAU);
                let distance = random.uniform(size * 0.05, size);
                let centre = [distance * angle.cos(), distance * angle.sin()];
                let shape = if random.uniform(0.0, 1.0) < 0.35 {
                    Shape::Pole { centre, radius: random.uniform(0.03, 0.4), top: random.uniform(0.0, 5.0) }
                } else {
                    let (sin, cos) = random.uniform(0.0, std::f64::consts::TAU).sin_cos();
                    let high = random.pick(&[0.7, 1.0, 4.0]);
                    let half = [random.uniform(0.2, size * 0.12), random.uniform(0.2, size * 0.04), high];
                    Shape::Box { centre: [centre[0], centre[1], high - 1.7], half, cos, sin }
                };
                (shape, surface(random))
            })
            .filter(|(shape, _)| match shape {
                // Nothing around the sensor itself.
                Shape::Box { centre, half, .. } => centre[0].hypot(centre[1]) > half[0].hypot(half[1]) + 0.3,
                Shape::Pole { centre, radius, .. } => centre[0].hypot(centre[1]) > radius + 0.3,
            })
            .collect();
        Self {
            shapes,
            ground: surface(random),
            tilt: [random.normal() * 0.01, random.normal() * 0.01],
            roughness: random.pick(&[0.002, 0.01, 0.03]),
            height: random.uniform(0.8, 2.0),
        }
    }

    fn hit(&self, from: [f64; 3], ray: [f64; 3]) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        let mut offer = |range: f64, facing: f64, surface: Surface| {
            if range > 0.3 && best.as_ref().is_none_or(|hit| range < hit.range) {
                best = Some(Hit { range, facing: facing.abs(), surface });
            }
        };
        let down = ray[2] - self.tilt[0] * ray[0] - self.tilt[1] * ray[1];
        if down < -1e-3 {
            let over = self.height + from[2] - self.tilt[0] * from[0] - self.tilt[1] * from[1];
            offer(over / -down, down, self.ground);
        }
        for (shape, surface) in &self.shapes {
            match shape {
                Shape::Box { centre, half, cos, sin } => {
                    let turn = |x: f64, y: f64| [x * cos + y * sin, y * cos - x * sin];
                    let [x, y] = turn(from[0] - centre[0], from[1] - centre[1]);
                    let [dx, dy] = turn(ray[0], ray[1]);
                    let (o, d) = ([x, y, from[2] - centre[2]], [dx, dy, ray[2]]);
                    let (mut near, mut far, mut facing) = (f64::NEG_INFINITY, f64::INFINITY, 0.0);
                    for axis in 0..3 {
                        let inverse = 1.0 / d[axis];
                        let (a, b) = ((-half[axis] - o[axis]) * inverse, (half[axis] - o[axis]) * inverse);
                        if a.min(b) > near {
                            (near, facing) = (a.min(b), d[axis]);
                        }
                        far = far.min(a.max(b));
                    }
                    if near <= far {
                        offer(near, facing, *surface);
                    }
                }
                Shape::Pole { centre, radius, top } => {
                    let (x, y) = (from[0] - centre[0], from[1] - centre[1]);
                    let a = ray[0] * ray[0] + ray[1] * ray[1];
                    let b = x * ray[0] + y * ray[1];
                    let root = b * b - a * (x * x + y * y - radius * radius);
                    if root > 0.0 {
                        let range = (-b - root.sqrt()) / a;
                        if from[2] + ray[2] * range < *top {
                            offer(range, root.sqrt() / radius, *surface);
                        }
                    }
                }
            }
        }
        best
    }

    /// A sweep ring by ring: R, G, B or an intensity in the fourth word. `None` where nothing came back.
    pub fn sweep(&self, random: &mut Random, levels: f64) -> Vec<Point> {
        let rings = random.pick(&[16, 32, 64]);
        let (low, high) = random.pick(&[(-25.0, 3.0), (-15.0, 15.0), (-24.0, 10.0)]);
        let step = random.pick(&[0.1_f64, 0.18, 0.2, 0.35]).to_radians();
        let (noise, jitter) = (random.pick(&[0.008, 0.015, 0.025]), random.uniform(0.0, 0.06) * step);
        let (lost, offset) = (random.uniform(0.0, 0.15), random.uniform(0.0, 0.1));
        let reach = random.uniform(60.0, 110.0);
        let mut points = Vec::new();
        for ring in (0..rings).rev() {
            let elevation = (low
                + (high - low) * (f64::from(ring) + random.uniform(-0.2, 0.2)) / f64::from(rings))
            .to_radians();
            let from = [0.0, 0.0, if ring % 2 == 0 { offset } else { 0.0 }];
            let mut azimuth = 0.0;
            while azimuth < std::f64::consts::TAU {
                azimuth += step;
                let bearing = azimuth + jitter * random.normal();
                let (sin, cos) = bearing.sin_cos();
                let ray = [cos * elevation.cos(), sin * elevation.cos(), elevation.sin()];
                let Some(hit) = self.hit(from, ray) else { continue };
                let rough = self.roughness * random.normal() / hit.facing.max(0.05);
                let range = hit.range + noise * random.normal() + rough.clamp(-0.3, 0.3);
                if range > reach || range < 0.5 || random.uniform(0.0, 1.0) < lost {
                    continue;
                }
                let back = hit.surface.reflectivity
                    * (0.3 + 0.7 * hit.facing)
                    * (1.0 + hit.surface.grain * random.normal())
                    - 0.04;
                let level = (back.clamp(0.0, 1.0) * levels).round();
                let intensity = (level * 255.0 / levels).round() as u32;
                let at: [f64; 3] = std::array::from_fn(|axis| from[axis] + ray[axis] * range);
                points.push([at[0] as f32, at[1] as f32, at[2] as f32, f32::from_bits(intensity)]);
            }
        }
        points
    }

    /// A depth camera's picture in raster order, optical axes (z forward, y down), looking along x of the scene.
    pub fn picture(&self, random: &mut Random, from: [f64; 3], heading: f64) -> Vec<Point> {
        let (width, height, focal) = (320, 200, 260.0);
        let noise = random.pick(&[0.0005, 0.0015, 0.004]);
        let grey = random.pick(&[1.0, 3.0, 6.0]);
        let mut points = Vec::new();
        for v in 0..height {
            for u in 0..width {
                let x = (f64::from(u) - 160.0) / focal;
                let y = (f64::from(v) - 60.0) / focal;
                let (sin, cos) = heading.sin_cos();
                let Some(hit) = self.hit(from, [cos + x * sin, sin - x * cos, -y]) else { continue };
                let z = hit.range + noise * hit.range * hit.range * random.normal();
                if !(0.3..=15.0).contains(&z) {
                    continue;
                }
                let light =
                    0.4 + 0.6 * hit.facing + 0.3 * hit.surface.grain * ((x * 20.0 + hit.range * 9.0).sin());
                let colour = hit.surface.colour.iter().rev().fold(255_u32, |bits, channel| {
                    bits << 8 | (channel * light + grey * random.normal()).clamp(0.0, 255.0) as u32
                });
                points.push([(x * z) as f32, (y * z) as f32, z as f32, f32::from_bits(colour)]);
            }
        }
        points
    }

    /// Several pictures in one frame of reference.
    pub fn merged(&self, random: &mut Random) -> Vec<Point> {
        let mut points = Vec::new();
        for view in 0..4 {
            let from = [random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.2, 0.2)];
            let heading = f64::from(view) * std::f64::consts::FRAC_PI_2;
            let (sin, cos) = heading.sin_cos();
            points.extend(self.picture(random, from, heading).into_iter().map(|[x, y, z, colour]| {
                let (x, y, z) = (f64::from(x), f64::from(y), f64::from(z));
                let at = [z * cos + x * sin + from[0], z * sin - x * cos + from[1], from[2] - y];
                [at[0] as f32, at[1] as f32, at[2] as f32, colour]
            }));
        }
        points
    }
}
