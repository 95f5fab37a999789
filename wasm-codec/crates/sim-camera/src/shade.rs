//! Colour of every visible pixel: procedural textures under ceiling lamps.
//!
//! The alpha byte of the result is not opacity: it holds the probability, out of 255, that stereo matching
//! fails there (gloss, no texture, a grazing view). The stereo pass uses it and sets it to 255.

use crate::config::Config;
use crate::pose::Pose;
use crate::raster::{NOTHING, Raster, Surface};
use crate::scene::{Material, Scene, TextureKind};
use crate::simd::{F32x4, I32x4, hash, hash_cell, ramp, unit};

type Colour = [F32x4; 3];

/// What a texture may look at: four neighbouring pixels of one face.
#[derive(Clone, Copy)]
struct Sample {
    u: F32x4,
    v: F32x4,
    /// Inverse of a pixel's width on the surface, 1/m: textures fade where their detail is finer.
    sharpness: F32x4,
}

impl Sample {
    /// 1 where a detail of this size (metres) is well resolved, towards 0 where it is not.
    #[inline(always)]
    fn resolved(self, size: f32) -> F32x4 {
        (self.sharpness * F32x4::splat(size * 0.7)).min(F32x4::splat(1.0))
    }
}

/// Fills `colour` (R, G, B, matching failure; one word a pixel) from the visibility buffer.
pub fn shade(config: &Config, scene: &Scene, camera: &Pose, raster: &Raster, colour: &mut [u32]) {
    let width = raster.width;
    let view = View::new(config, scene, camera);
    for row in 0..raster.height {
        let start = row * width;
        let ids = &raster.index[start..start + width];
        let mut x = 0;
        while x < width {
            let id = ids[x];
            let mut end = x + 1;
            while end < width && ids[end] == id {
                end += 1;
            }
            if id == NOTHING {
                colour[start + x..start + end].fill(0);
            } else {
                let surface = &raster.surfaces[id as usize];
                let run = Run { row, first: x, end, start };
                shade_run(&view, surface, &scene.materials[surface.material], raster, run, colour);
            }
            x = end;
        }
    }
}

struct View {
    fx: f32,
    cx: f32,
    fy: f32,
    cy: f32,
    /// Rows of the camera's rotation into the world, each with the camera's position.
    world: [[f32; 4]; 3],
    lamp: f32,
}

impl View {
    fn new(config: &Config, scene: &Scene, camera: &Pose) -> Self {
        let r = &camera.rotation;
        Self {
            fx: config.fx as f32,
            cx: config.cx as f32,
            fy: config.fy as f32,
            cy: config.cy as f32,
            world: core::array::from_fn(|i| {
                [r[i][0] as f32, r[i][1] as f32, r[i][2] as f32, camera.translation[i] as f32]
            }),
            lamp: 1.0 / scene.lamp_spacing,
        }
    }
}

/// Pixels `first..end` of a row that show one face; the row begins at `start` in the buffers.
#[derive(Clone, Copy)]
struct Run {
    row: usize,
    first: usize,
    end: usize,
    start: usize,
}

fn shade_run(
    view: &View,
    surface: &Surface,
    material: &Material,
    raster: &Raster,
    run: Run,
    colour: &mut [u32],
) {
    let first = material.first.map(F32x4::splat);
    let second = material.second.map(F32x4::splat);
    let p = material.parameters;
    let seed = material.seed;
    // One loop for each texture, so that the choice costs a jump a run and not a jump a pixel.
    macro_rules! with {
        ($texture:expr) => {
            fill(view, surface, material, raster, run, colour, $texture)
        };
    }
    match material.kind {
        TextureKind::Flat => with!(|_s: Sample| first),
        TextureKind::Checker => with!(|s: Sample| checker(s, first, second, p)),
        TextureKind::Tile => with!(|s: Sample| tile(s, first, second, p, seed)),
        TextureKind::Stripes => with!(|s: Sample| stripes(s, first, second, p)),
        TextureKind::Grain => with!(|s: Sample| grain(s, first, second, p, seed)),
        TextureKind::Text => with!(|s: Sample| text(s, first, second, p, seed)),
        TextureKind::Books => with!(|s: Sample| books(s, first, p, seed)),
        TextureKind::Wood => with!(|s: Sample| wood(s, first, second, p, seed)),
        TextureKind::Smooth => with!(|s: Sample| first.map(|c| c * s.u)),
        TextureKind::Picture => with!(|s: Sample| picture(s, first, second, p, seed)),
    }
}

#[inline(always)]
fn fill(
    view: &View,
    surface: &Surface,
    material: &Material,
    raster: &Raster,
    run: Run,
    colour: &mut [u32],
    texture: impl Fn(Sample) -> Colour,
) {
    let splat = F32x4::splat;
    let one = splat(1.0);
    let zero = splat(0.0);
    let ray_y = (run.row as f32 - view.cy) / view.fy;
    // Each is an affine function of the pixel, times depth: precompute its value at x = 0 and its step.
    let along_row = |f: [f32; 4]| {
        let step = f[0] / view.fx;
        (splat(step), splat(f[1] * ray_y + f[2] - step * view.cx), splat(f[3]))
    };
    let u = along_row(surface.u);
    let v = along_row(surface.v);
    let world = view.world.map(along_row);
    let at = |f: (F32x4, F32x4, F32x4), x: F32x4, depth: F32x4| (f.0 * x + f.1) * depth + f.2;

    let n = surface.normal;
    // Two soft lights from above and the walls' own reflections: neighbouring faces differ in brightness.
    let facing = 0.70 + 0.18 * n[2] + 0.10 * n[0] - 0.07 * n[1] + 0.05 * (n[0] * n[0]);
    let lit = 1.0 - material.emission;
    let brightness = splat(facing * lit + material.emission);
    let pool = splat(0.75 * lit);
    // Upright faces darken towards the floor.
    let contact = splat(0.35 * (1.0 - n[2].abs()) * lit);
    let lamp = splat(view.lamp);
    let grazing = splat(surface.distance * 9.0);
    let sharpness = splat(surface.distance * view.fx);
    let unmatched = material.unmatched;

    let mut x = run.first;
    while x < run.end {
        let pixel = run.start + x;
        // Past the run's end lies another face's depth, but the run that owns it writes later.
        let inverse = F32x4::load(&raster.inverse_depth[pixel..]).max(splat(1e-3));
        let depth = one / inverse;
        let column = ramp(x as f32);
        let sample = Sample {
            u: at(u, column, depth),
            v: at(v, column, depth),
            sharpness: sharpness * inverse * inverse,
        };
        let base = texture(sample);

        let lamp_x = at(world[0], column, depth) * lamp;
        let lamp_y = at(world[1], column, depth) * lamp;
        let lamp_x = lamp_x - lamp_x.nearest();
        let lamp_y = lamp_y - lamp_y.nearest();
        let low = (one - at(world[2], column, depth) * splat(4.0)).max(zero);
        let light =
            brightness * (one - pool * (lamp_x * lamp_x + lamp_y * lamp_y)) * (one - contact * low * low);
        let level = |c: F32x4| ((c * light).max(zero).min(one) * splat(255.0)).nearest().to_i32();

        // A view along the surface leaves the matcher little to compare.
        let mut failure = (one - grazing * inverse).max(zero) * splat(0.6);
        if unmatched > 0.0 {
            failure = failure + patches(sample, unmatched, material.seed);
        }
        let failure = (failure.min(one) * splat(255.0)).to_i32();
        let word =
            level(base[0]) | level(base[1]).shl::<8>() | level(base[2]).shl::<16>() | failure.shl::<24>();
        word.store(&mut colour[pixel..]);
        x += 4;
    }
}

/// Patches of a surface, fixed to it, on which matching mostly fails; they cover a share of it.
#[inline(always)]
fn patches(s: Sample, share: f32, seed: i32) -> F32x4 {
    let cell = |size: f32, salt: i32| {
        let scale = F32x4::splat(1.0 / size);
        unit(hash_cell((s.u * scale).floor().to_i32(), (s.v * scale).floor().to_i32(), seed ^ salt))
    };
    let mix = cell(0.22, 0x51) * F32x4::splat(0.7) + cell(0.05, 0x52) * F32x4::splat(0.3);
    ((mix - F32x4::splat(1.0 - share)) * F32x4::splat(8.0)).max(F32x4::splat(0.0)).min(F32x4::splat(0.95))
}

#[inline(always)]
fn mix(a: Colour, b: Colour, t: F32x4) -> Colour {
    core::array::from_fn(|i| a[i] + (b[i] - a[i]) * t)
}

/// 1 where the mask is set, 0 elsewhere.
#[inline(always)]
fn flag(mask: I32x4) -> F32x4 {
    F32x4::splat(1.0).select(F32x4::splat(0.0), mask)
}

/// Cell index and the position within the cell, 0 to 1.
#[inline(always)]
fn cell(value: F32x4, size: f32) -> (I32x4, F32x4) {
    let scaled = value * F32x4::splat(1.0 / size);
    let whole = scaled.floor();
    (whole.to_i32(), scaled - whole)
}

#[inline(always)]
fn checker(s: Sample, first: Colour, second: Colour, p: [f32; 4]) -> Colour {
    let (i, _) = cell(s.u, p[0]);
    let (j, _) = cell(s.v, p[0]);
    let odd = ((i + j) & I32x4::splat(1)).to_f32();
    let half = F32x4::splat(0.5);
    mix(first, second, half + (odd - half) * s.resolved(p[0]))
}

#[inline(always)]
fn tile(s: Sample, first: Colour, second: Colour, p: [f32; 4], seed: i32) -> Colour {
    let (row, in_v) = cell(s.v, p[1]);
    let shift = row.to_f32() * F32x4::splat(p[0] * p[3]);
    let (column, in_u) = cell(s.u + shift, p[0]);
    let one = F32x4::splat(1.0);
    let tint = (unit(hash_cell(column, row, seed)) - F32x4::splat(0.5)) * F32x4::splat(0.16);
    let tint = one + tint * s.resolved(p[0].min(p[1]));
    let joint = in_u.lt(F32x4::splat(p[2] / p[0])) | in_v.lt(F32x4::splat(p[2] / p[1]));
    let joint = flag(joint) * s.resolved(p[2] * 3.0);
    mix(first.map(|c| c * tint), second, joint)
}

#[inline(always)]
fn stripes(s: Sample, first: Colour, second: Colour, p: [f32; 4]) -> Colour {
    let across = s.u * F32x4::splat(1.0 - p[2]) + s.v * F32x4::splat(p[2]);
    let (_, within) = cell(across, p[0]);
    let share = F32x4::splat(p[1]);
    let on = flag(within.lt(share));
    mix(first, second, share + (on - share) * s.resolved(p[0]))
}

#[inline(always)]
fn grain(s: Sample, first: Colour, second: Colour, p: [f32; 4], seed: i32) -> Colour {
    let (i, _) = cell(s.u, p[0]);
    let (j, _) = cell(s.v, p[0]);
    let fine = unit(hash_cell(i, j, seed));
    let (i, _) = cell(s.u, p[0] * 5.0);
    let (j, _) = cell(s.v, p[0] * 5.0);
    let coarse = unit(hash_cell(i, j, seed ^ 0x33));
    let half = F32x4::splat(0.5);
    let t = half
        + (fine - half) * F32x4::splat(0.65) * s.resolved(p[0])
        + (coarse - half) * F32x4::splat(0.35) * s.resolved(p[0] * 5.0);
    mix(first, second, t)
}

#[inline(always)]
fn text(s: Sample, first: Colour, second: Colour, p: [f32; 4], seed: i32) -> Colour {
    let height = p[0];
    let (line, in_line) = cell(s.v, height);
    let (letter, in_letter) = cell(s.u, height * 0.45);
    let lane = |low: f32, high: f32, t: F32x4| t.gt(F32x4::splat(low)) & t.lt(F32x4::splat(high));
    let which = hash_cell(letter, line, seed);
    // A third of the cells are spaces or the edges between words.
    let letter_here = (which & I32x4::splat(7)).lt(I32x4::splat(6));
    // Strokes of a letter: a stem, and some of three bars.
    let bit = |n: i32| (I32x4::splat(0)).lt(which & I32x4::splat(n));
    let stem = lane(0.1, 0.32, in_letter) & lane(0.2, 0.8, in_line);
    let back = lane(0.6, 0.82, in_letter) & lane(0.2, 0.8, in_line) & bit(0x100);
    let bars = (lane(0.2, 0.32, in_line) & bit(0x200))
        | (lane(0.44, 0.56, in_line) & bit(0x400))
        | (lane(0.68, 0.8, in_line) & bit(0x800));
    let ink = flag((stem | back | (bars & lane(0.1, 0.82, in_letter))) & letter_here);
    let resolved = s.resolved(height * 0.5);
    // Unresolved print is grey lines.
    let grey = flag(lane(0.2, 0.8, in_line)) * F32x4::splat(0.45);
    mix(first, second, grey + (ink - grey) * resolved)
}

#[inline(always)]
fn books(s: Sample, back: Colour, p: [f32; 4], seed: i32) -> Colour {
    let (pair, in_pair) = cell(s.u, p[0] * 2.0);
    let one = I32x4::splat(1);
    // Two books share each cell; where they meet differs, so widths do.
    let split = unit(hash_cell(pair, one, seed ^ 0x77)) * F32x4::splat(0.3) + F32x4::splat(0.35);
    let book = pair.shl::<1>() + (one & in_pair.gt(split));
    let which = hash_cell(book, one, seed);
    let byte = |h: I32x4| (h & I32x4::splat(255)).to_f32() * F32x4::splat(1.0 / 255.0);
    let tall = F32x4::splat(p[1]) * (F32x4::splat(0.68) + byte(which) * F32x4::splat(0.3));
    let absent = which.shr::<8>() & I32x4::splat(15);
    let present = s.v.lt(tall) & I32x4::splat(0).lt(absent);
    let more = hash(which);
    let spine = [0.0f32, 1.0, 2.0].map(|channel| {
        let level = match channel as i32 {
            0 => byte(more),
            1 => byte(more.shr::<8>()),
            _ => byte(more.shr::<16>()),
        };
        F32x4::splat(0.12) + level * F32x4::splat(0.75)
    });
    let band = s.v.gt(tall * F32x4::splat(0.7)) & s.v.lt(tall * F32x4::splat(0.82));
    let label = F32x4::splat(0.5) * flag(band) * s.resolved(p[0]);
    let spine = spine.map(|c| c + (F32x4::splat(0.95) - c) * label);
    mix(back, spine, flag(present))
}

#[inline(always)]
fn wood(s: Sample, first: Colour, second: Colour, p: [f32; 4], seed: i32) -> Colour {
    let (streak, within) = cell(s.v, p[0]);
    let at = |lane: I32x4| {
        let offset = unit(hash_cell(lane, I32x4::splat(3), seed));
        let (along, _) = cell(s.u + offset, p[0] * 18.0);
        unit(hash_cell(along, lane, seed))
    };
    let (here, next) = (at(streak), at(streak + I32x4::splat(1)));
    let t = here + (next - here) * within;
    let half = F32x4::splat(0.5);
    mix(first, second, half + (t - half) * s.resolved(p[0]))
}

#[inline(always)]
fn picture(s: Sample, sky: Colour, hills: Colour, p: [f32; 4], seed: i32) -> Colour {
    let splat = F32x4::splat;
    let one = splat(1.0);
    let (u, v) = (s.u * splat(1.0 / p[0]), s.v * splat(1.0 / p[1]));
    let shift = (seed & 15) as f32 / 16.0;
    let hill = |centre: f32, height: f32, width: f32| {
        let d = (u - splat(centre)) * splat(1.0 / width);
        splat(height) * (one - d * d)
    };
    let far = hill(0.25 + 0.5 * shift, 0.62, 0.7).max(hill(0.9 - 0.4 * shift, 0.5, 0.5));
    let near = hill(0.1 + 0.8 * shift, 0.35, 0.8);
    let (dx, dy) = (u - splat(0.72 - 0.4 * shift), (v - splat(0.78)) * splat(p[1] / p[0]));
    let sun = flag((dx * dx + dy * dy).lt(splat(0.012)));
    let haze = (one - v).max(splat(0.0)) * splat(0.6);
    let mut colour: Colour = sky.map(|c| c + (one - c) * haze);
    colour = mix(colour, [splat(0.98), splat(0.85), splat(0.4)], sun);
    colour = mix(colour, hills.map(|c| c + (splat(0.75) - c) * splat(0.35)), flag(v.lt(far)));
    colour = mix(colour, hills.map(|c| c * splat(0.7)), flag(v.lt(near)));
    let frame = splat(0.04);
    let border = u.lt(frame) | v.lt(frame) | u.gt(one - frame) | v.gt(one - frame);
    mix(colour, [splat(0.93); 3], flag(border))
}
