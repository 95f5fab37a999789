//! Synthetic frames to train the organised codec's tables on: rooms full of boxes and balls with textures of every
//! grain, seen by depth cameras of several makes. The same seed gives the same frames.

use farpoint_organised_codec::Point;

/// xorshift64*, good enough for pictures.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// 0 ≤ x < 1.
    pub fn uniform(&mut self) -> f32 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 40) as f32 / (1 << 24) as f32
    }

    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.uniform()
    }

    /// Mean 0, deviation 1, near enough normal.
    #[allow(clippy::approx_constant, reason = "another last digit would train other tables")]
    pub fn normal(&mut self) -> f32 {
        (0..6).map(|_| self.uniform()).sum::<f32>() * 1.414_2 - 4.242_6
    }
}

/// A depth camera's faults.
#[derive(Clone, Copy)]
pub struct Sensor {
    pub width: usize,
    pub height: usize,
    pub focal: f32,
    /// Steps of inverse depth that the matcher gives, 1/m; 0 for none.
    pub lattice: f32,
    /// Deviation of inverse depth, 1/m: from pixel to pixel, and over a few pixels.
    pub white: f32,
    pub smooth: f32,
    /// Depth in whole millimetres.
    pub millimetres: bool,
    /// Share of pixels lost at random.
    pub speckle: f32,
    /// Colour noise, levels of 255.
    pub colour_noise: f32,
    /// How blurred the picture is: weight of each neighbour.
    pub blur: f32,
}

struct Texture {
    base: [f32; 3],
    other: [f32; 3],
    grain: f32,
    contrast: f32,
    cells: f32,
    seed: u32,
}

struct Shape {
    centre: [f32; 3],
    half: [f32; 3],
    yaw: (f32, f32),
    ball: bool,
    texture: Texture,
}

fn hash(x: i32, y: i32, z: i32, seed: u32) -> f32 {
    let mut h = seed ^ (x as u32).wrapping_mul(0x8da6_b343) ^ (y as u32).wrapping_mul(0xd816_3841);
    h ^= (z as u32).wrapping_mul(0xcb1a_b31f);
    h = (h ^ h >> 15).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ h >> 12).wrapping_mul(0x297a_2d39);
    (h ^ h >> 15) as f32 / u32::MAX as f32
}

fn value_noise(p: [f32; 3], seed: u32) -> f32 {
    let cell = p.map(f32::floor);
    let f: [f32; 3] = core::array::from_fn(|i| {
        let t = p[i] - cell[i];
        t * t * (3.0 - 2.0 * t)
    });
    let c = cell.map(|v| v as i32);
    let mut sum = 0.0;
    for corner in 0..8 {
        let d = [corner & 1, corner >> 1 & 1, corner >> 2];
        let weight: f32 = (0..3).map(|i| if d[i] == 1 { f[i] } else { 1.0 - f[i] }).product();
        sum += weight * hash(c[0] + d[0], c[1] + d[1], c[2] + d[2], seed);
    }
    sum - 0.5
}

impl Texture {
    fn random(random: &mut Random) -> Self {
        let grey = random.between(40.0, 210.0);
        let tint = random.between(0.0, 1.0).powi(2) * 80.0;
        let mut colour = || core::array::from_fn(|_| (grey + random.between(-tint, tint)).clamp(0.0, 255.0));
        let (base, other) = (colour(), colour());
        Self {
            base,
            other,
            grain: random.between(0.5, 6.0),
            contrast: random.uniform().powi(2) * 120.0,
            cells: if random.uniform() < 0.5 { 0.0 } else { random.between(2.0, 20.0) },
            seed: (random.uniform() * 1e9) as u32,
        }
    }

    fn at(&self, p: [f32; 3]) -> [f32; 3] {
        let mut noise = 0.0;
        let (mut scale, mut weight) = (self.grain, 0.6);
        for octave in 0..7 {
            noise += weight * value_noise(p.map(|v| v * scale), self.seed + octave);
            scale *= 2.0;
            weight *= 0.62;
        }
        let mut mix = (0.5 + noise).clamp(0.0, 1.0);
        if self.cells > 0.0 {
            let c = p.map(|v| (v * self.cells).floor() as i32);
            mix = (0.3 * mix + hash(c[0], c[1], c[2], self.seed) * 0.7).round() * 0.8 + 0.2 * mix;
        }
        core::array::from_fn(|i| self.base[i] + (self.other[i] - self.base[i]) * mix + noise * self.contrast)
    }
}

impl Shape {
    /// Distance along the ray and the normal.
    fn hit(&self, origin: [f32; 3], ray: [f32; 3], inside: bool) -> Option<(f32, [f32; 3])> {
        let (s, c) = self.yaw;
        let turn = |v: [f32; 3]| [c * v[0] + s * v[2], v[1], -s * v[0] + c * v[2]];
        let o = turn(core::array::from_fn(|i| origin[i] - self.centre[i]));
        let d = turn(ray);
        if self.ball {
            let r = self.half[0];
            let (a, b) = (dot(d, d), dot(o, d));
            let root = b * b - a * (dot(o, o) - r * r);
            if root < 0.0 {
                return None;
            }
            let t = (-b - root.sqrt()) / a;
            return (t > 0.0).then(|| (t, core::array::from_fn(|i| (o[i] + t * d[i]) / r)));
        }
        let (mut enter, mut leave, mut axis_in, mut axis_out) = (f32::MIN, f32::MAX, 0, 0);
        for i in 0..3 {
            let (a, b) = ((-self.half[i] - o[i]) / d[i], (self.half[i] - o[i]) / d[i]);
            let (low, high) = (a.min(b), a.max(b));
            if low > enter {
                (enter, axis_in) = (low, i);
            }
            if high < leave {
                (leave, axis_out) = (high, i);
            }
        }
        let (t, axis) = if inside { (leave, axis_out) } else { (enter, axis_in) };
        if enter > leave || t <= 0.0 {
            return None;
        }
        let mut normal = [0.0; 3];
        normal[axis] = 1.0;
        Some((t, normal))
    }
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A frame of a random room.
pub fn frame(seed: u64, sensor: &Sensor) -> Vec<Point> {
    let mut random = Random::new(seed);
    let (w, h) = (sensor.width, sensor.height);
    let size = random.between(1.5, 6.0);
    let mut shapes = vec![Shape {
        centre: [0.0, 0.0, size * 0.5],
        half: [size, random.between(1.1, 1.6), size * random.between(0.6, 1.5)],
        yaw: random.between(-0.6, 0.6).sin_cos(),
        ball: false,
        texture: Texture::random(&mut random),
    }];
    for _ in 0..(random.between(5.0, 30.0) as usize) {
        let ball = random.uniform() < 0.4;
        let scale = random.between(0.03, 0.5) * size * 0.5;
        shapes.push(Shape {
            centre: [
                random.between(-0.6, 0.6) * size,
                random.between(-0.8, 1.1),
                random.between(0.35, 1.2) * size,
            ],
            half: core::array::from_fn(
                |i| if ball && i > 0 { scale } else { scale * random.between(0.3, 1.5) },
            ),
            yaw: random.between(-3.0, 3.0).sin_cos(),
            ball,
            texture: Texture::random(&mut random),
        });
    }
    let pitch = random.between(-0.3, 0.6);
    let (s, c) = pitch.sin_cos();
    let light = [random.between(-1.0, 1.0), random.between(-1.0, 0.2), random.between(-1.0, 0.0)];
    let mut inverse = vec![0.0_f32; w * h];
    let mut picture = vec![[0.0_f32; 3]; w * h];
    for v in 0..h {
        for u in 0..w {
            let x = (u as f32 - (w as f32 - 1.0) / 2.0) / sensor.focal;
            let y = (v as f32 - (h as f32 - 1.0) / 2.0) / sensor.focal;
            let ray = [x, c * y + s, -s * y + c];
            let mut best: Option<(f32, [f32; 3], usize)> = None;
            for (i, shape) in shapes.iter().enumerate() {
                if let Some((t, normal)) = shape.hit([0.0, -0.2, 0.0], ray, i == 0)
                    && best.is_none_or(|(nearest, ..)| t < nearest)
                {
                    best = Some((t, normal, i));
                }
            }
            let Some((t, normal, shape)) = best else { continue };
            inverse[v * w + u] = 1.0 / t;
            let shade = 0.55 + 0.45 * (dot(normal, light) / dot(light, light).sqrt()).abs();
            let p: [f32; 3] = core::array::from_fn(|i| ray[i] * t);
            picture[v * w + u] = shapes[shape].texture.at(p).map(|level| level * shade);
        }
    }
    let picture = soften(&picture, w, h, sensor.blur);
    let colour_noise: Vec<[f32; 3]> =
        (0..w * h).map(|_| core::array::from_fn(|_| random.normal() * sensor.colour_noise)).collect();
    // A mosaic sensor's noise is smooth over neighbours.
    let colour_noise = soften(&colour_noise, w, h, 0.5);
    let blobs: Vec<[f32; 3]> = (0..w * h).map(|_| [random.normal(), 0.0, 0.0]).collect();
    let blobs = soften(&soften(&blobs, w, h, 1.0), w, h, 1.0);
    let mut points = Vec::with_capacity(w * h);
    for v in 0..h {
        for u in 0..w {
            let at = v * w + u;
            let mut depth = inverse[at];
            // The far side of an edge is hidden from the second eye.
            let hidden =
                (1..12.min(u + 1)).any(|i| (inverse[at - i] - depth) * sensor.focal * 0.06 > i as f32 + 0.5);
            depth += random.normal() * sensor.white + blobs[at][0] * 4.0 * sensor.smooth;
            if sensor.lattice > 0.0 {
                depth = (depth / sensor.lattice).round() * sensor.lattice;
            }
            let mut z = 1.0 / depth;
            if sensor.millimetres {
                z = (z * 1000.0).round() / 1000.0;
            }
            if hidden || random.uniform() < sensor.speckle || !(0.3..12.0).contains(&z) {
                z = f32::NAN;
            }
            let level =
                |i: usize| (picture[at][i] + colour_noise[at][i] * 1.5).round().clamp(0.0, 255.0) as u32;
            let rgba = level(0) | level(1) << 8 | level(2) << 16 | 0xff00_0000;
            let x = (u as f32 - (w as f32 - 1.0) / 2.0) / sensor.focal * z;
            let y = (v as f32 - (h as f32 - 1.0) / 2.0) / sensor.focal * z;
            points.push([x, y, z, f32::from_bits(rgba)]);
        }
    }
    points
}

/// Each pixel with its four neighbours.
fn soften(picture: &[[f32; 3]], w: usize, h: usize, weight: f32) -> Vec<[f32; 3]> {
    let mut soft = Vec::with_capacity(w * h);
    for v in 0..h {
        for u in 0..w {
            let around = [
                (u.saturating_sub(1), v),
                ((u + 1).min(w - 1), v),
                (u, v.saturating_sub(1)),
                (u, (v + 1).min(h - 1)),
            ];
            soft.push(core::array::from_fn(|i| {
                let sum: f32 = around.iter().map(|(u, v)| picture[v * w + u][i]).sum();
                (picture[v * w + u][i] + weight * sum) / (1.0 + 4.0 * weight)
            }));
        }
    }
    soft
}
