//! Colour of every visible pixel: textures under ceiling lamps.
//!
//! The alpha byte of the result is not opacity: it holds the probability, out of 255, that stereo matching
//! fails there (gloss, no texture, a grazing view). The stereo pass uses it and sets it to 255.

use crate::config::Config;
use crate::pose::Pose;
use crate::raster::{NOTHING, PixelAffine, Raster, Surface, along_rays};
use crate::scene::{Material, Scene, TextureKind};
use crate::simd::{F32x4, I32x4, byte_bits, ramp};
use crate::texture::{Colour, Sample, books, checker, grain, patches, picture, stripes, text, tile, wood};

/// Shades a frame's rows, one at a time.
pub struct Shader<'a> {
    view: View,
    scene: &'a Scene,
    raster: &'a Raster,
}

impl<'a> Shader<'a> {
    pub fn new(config: &Config, scene: &'a Scene, camera: &Pose, raster: &'a Raster) -> Self {
        Self { view: View::new(config, scene, camera), scene, raster }
    }

    /// Fills a row of `colour`, the whole picture's (R, G, B, matching failure; one word a pixel). Up to three words after
    /// the row are overwritten too.
    #[inline(never)]
    pub fn shade(&self, row: usize, colour: &mut [u32]) {
        let raster = self.raster;
        let width = raster.width;
        let start = row * width;
        let ids = &raster.index[start..start + width];
        let line = Line::new(&self.view, row);
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
                let material = &self.scene.materials[surface.material];
                let run = Run { row: row as f32, first: x, end, focal: self.view.focal };
                let depths = &raster.inverse_depth[start..start + end + 4];
                let colour = &mut colour[start..start + end + 4];
                shade_run(&line, surface, material, run, depths, colour);
            }
            x = end;
        }
    }
}

struct View {
    focal: f32,
    /// World x and y in units of the lamps' spacing, and minus four times the height plus one.
    lamp_x: (PixelAffine, f32),
    lamp_y: (PixelAffine, f32),
    low: (PixelAffine, f32),
}

impl View {
    fn new(config: &Config, scene: &Scene, camera: &Pose) -> Self {
        let world = |axis: usize, scale: f64, offset: f64| {
            let direction = camera.rotation[axis].map(|r| r * scale);
            (along_rays(config, direction), (camera.translation[axis] * scale + offset) as f32)
        };
        let lamp = 1.0 / f64::from(scene.lamp_spacing);
        Self {
            focal: config.fx as f32,
            lamp_x: world(0, lamp, 0.0),
            lamp_y: world(1, lamp, 0.0),
            low: world(2, -4.0, 1.0),
        }
    }
}

/// A quantity along a row: depth times an affine function of the column, plus a constant.
#[derive(Clone, Copy)]
struct Along {
    step: F32x4,
    start: F32x4,
    constant: F32x4,
}

impl Along {
    #[inline(always)]
    fn new((function, constant): (PixelAffine, f32), row: f32) -> Self {
        Self {
            step: F32x4::splat(function[0]),
            start: F32x4::splat(function[1] * row + function[2]),
            constant: F32x4::splat(constant),
        }
    }

    #[inline(always)]
    fn at(self, column: F32x4, depth: F32x4) -> F32x4 {
        (self.step * column + self.start) * depth + self.constant
    }
}

/// What the lamps do along one row.
struct Line {
    lamp_x: Along,
    lamp_y: Along,
    low: Along,
}

impl Line {
    fn new(view: &View, row: usize) -> Self {
        let along = |f| Along::new(f, row as f32);
        Self { lamp_x: along(view.lamp_x), lamp_y: along(view.lamp_y), low: along(view.low) }
    }
}

/// Columns `first..end` of a row that show one face.
#[derive(Clone, Copy)]
struct Run {
    row: f32,
    first: usize,
    end: usize,
    focal: f32,
}

fn shade_run(
    line: &Line,
    surface: &Surface,
    material: &Material,
    run: Run,
    depths: &[f32],
    colour: &mut [u32],
) {
    let first = material.first.map(F32x4::splat);
    let second = material.second.map(F32x4::splat);
    let p = material.parameters;
    let seed = material.seed;
    // One loop for each texture, so that the choice costs a jump a run and not a jump a pixel.
    macro_rules! with {
        ($texture:expr) => {
            fill(line, surface, material, run, depths, colour, $texture)
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

#[inline(never)]
fn fill(
    line: &Line,
    surface: &Surface,
    material: &Material,
    run: Run,
    depths: &[f32],
    colour: &mut [u32],
    texture: impl Fn(Sample) -> Colour,
) {
    let splat = F32x4::splat;
    let one = splat(1.0);
    let zero = splat(0.0);
    let u = Along::new(surface.u, run.row);
    let v = Along::new(surface.v, run.row);

    let n = surface.normal;
    // Soft light from above and from the walls: neighbouring faces differ in brightness.
    let facing = 0.72 + 0.16 * n[2].max(0.0) - 0.04 * n[2].min(0.0) + 0.08 * n[0] - 0.06 * n[1];
    let lit = 1.0 - material.emission;
    let brightness = splat((facing * lit + material.emission) * 255.0);
    // Lamps hang in a grid; between them it is darker. Upright faces darken towards the floor.
    let pool = splat(0.75 * lit);
    let contact = splat(0.35 * (1.0 - n[2].abs()) * lit);
    // A view along the surface leaves the matcher little to compare.
    let failure_limit = splat(0.6 * 255.0);
    let grazing = splat(-0.6 * 255.0 * 9.0 * surface.distance);
    let sharpness = splat(surface.distance * run.focal);
    let unmatched = material.unmatched;

    let mut x = run.first;
    while x < run.end {
        // Past the run's end lies another face's depth, but the run that owns it writes later.
        let inverse = F32x4::load(&depths[x..]).max(splat(1e-3));
        let depth = one / inverse;
        let column = ramp(x as f32);
        let sample = Sample {
            u: u.at(column, depth),
            v: v.at(column, depth),
            sharpness: sharpness * inverse * inverse,
        };
        let base = texture(sample);

        let lamp_x = line.lamp_x.at(column, depth);
        let lamp_y = line.lamp_y.at(column, depth);
        let lamp_x = lamp_x - lamp_x.nearest();
        let lamp_y = lamp_y - lamp_y.nearest();
        let low = line.low.at(column, depth).max(zero);
        let light =
            brightness * (one - pool * (lamp_x * lamp_x + lamp_y * lamp_y)) * (one - contact * low * low);

        let mut failure = (failure_limit + grazing * inverse).max(zero);
        if unmatched > 0.0 {
            failure = failure + patches(sample, unmatched, material.seed);
        }
        let word = (byte_bits(base[0] * light) & I32x4::splat(255))
            | byte_bits(base[1] * light).shl::<8>()
            | byte_bits(base[2] * light).shl::<16>()
            | byte_bits(failure).shl::<24>();
        word.store(&mut colour[x..]);
        x += 4;
    }
}
