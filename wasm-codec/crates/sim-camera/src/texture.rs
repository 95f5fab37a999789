//! Procedural textures (see `scene::TextureKind`), four pixels at a time.

use crate::simd::{F32x4, I32x4, biased_bits, hash, hash_cell, unit};

pub type Colour = [F32x4; 3];

/// What a texture may look at: four neighbouring pixels of one face.
#[derive(Clone, Copy)]
pub struct Sample {
    pub u: F32x4,
    pub v: F32x4,
    /// Inverse of a pixel's width on the surface, 1/m: textures fade where their detail is finer.
    pub sharpness: F32x4,
}

impl Sample {
    /// 1 where a detail of this size (metres) is well resolved, towards 0 where it is not.
    #[inline(always)]
    fn resolved(self, size: f32) -> F32x4 {
        (self.sharpness * F32x4::splat(size * 0.7)).min(F32x4::splat(1.0))
    }
}

/// Patches of a surface, fixed to it, on which matching mostly fails (0 to 255); they cover a share of it.
#[inline(always)]
pub fn patches(s: Sample, share: f32, seed: i32) -> F32x4 {
    let half = F32x4::splat(0.5);
    let (i, _) = cell(s.u, 0.035);
    let (j, _) = cell(s.v, 0.035);
    let fine = unit(hash_cell(i, j, seed ^ 0x52));
    // The fine cells fray the edges of the coarse ones.
    let fray = (fine - half) * F32x4::splat(0.14);
    let (i, _) = cell(s.u + fray, 0.2);
    let (j, _) = cell(s.v - fray, 0.2);
    let coarse = unit(hash_cell(i, j, seed ^ 0x51));
    let mix = coarse * F32x4::splat(0.8) + fine * F32x4::splat(0.2);
    let failure = (mix - F32x4::splat(1.0 - share)) * F32x4::splat(8.0 * 255.0);
    failure.max(F32x4::splat(0.0)).min(F32x4::splat(0.95 * 255.0))
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

/// Cell index, less a constant, and the position within the cell, 0 to 1.
#[inline(always)]
fn cell(value: F32x4, size: f32) -> (I32x4, F32x4) {
    let scaled = value * F32x4::splat(1.0 / size);
    let whole = scaled.floor();
    (biased_bits(whole), scaled - whole)
}

#[inline(always)]
pub fn checker(s: Sample, first: Colour, second: Colour, p: [f32; 4]) -> Colour {
    let (i, _) = cell(s.u, p[0]);
    let (j, _) = cell(s.v, p[0]);
    let odd = ((i + j) & I32x4::splat(1)).to_f32();
    let half = F32x4::splat(0.5);
    mix(first, second, half + (odd - half) * s.resolved(p[0]))
}

#[inline(always)]
pub fn tile(s: Sample, first: Colour, second: Colour, p: [f32; 4], seed: i32) -> Colour {
    let (row, in_v) = cell(s.v, p[1]);
    let shift = (s.v - in_v * F32x4::splat(p[1])) * F32x4::splat(p[3] * p[0] / p[1]);
    let (column, in_u) = cell(s.u + shift, p[0]);
    let one = F32x4::splat(1.0);
    let tint = (unit(hash_cell(column, row, seed)) - F32x4::splat(0.5)) * F32x4::splat(0.16);
    let tint = one + tint * s.resolved(p[0].min(p[1]));
    let joint = in_u.lt(F32x4::splat(p[2] / p[0])) | in_v.lt(F32x4::splat(p[2] / p[1]));
    let joint = flag(joint) * s.resolved(p[2] * 3.0);
    mix(first.map(|c| c * tint), second, joint)
}

#[inline(always)]
pub fn stripes(s: Sample, first: Colour, second: Colour, p: [f32; 4]) -> Colour {
    let across = s.u * F32x4::splat(1.0 - p[2]) + s.v * F32x4::splat(p[2]);
    let (_, within) = cell(across, p[0]);
    let share = F32x4::splat(p[1]);
    let on = flag(within.lt(share));
    mix(first, second, share + (on - share) * s.resolved(p[0]))
}

#[inline(always)]
pub fn grain(s: Sample, first: Colour, second: Colour, p: [f32; 4], seed: i32) -> Colour {
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
pub fn text(s: Sample, first: Colour, second: Colour, p: [f32; 4], seed: i32) -> Colour {
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
pub fn books(s: Sample, back: Colour, p: [f32; 4], seed: i32) -> Colour {
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
pub fn wood(s: Sample, first: Colour, second: Colour, p: [f32; 4], seed: i32) -> Colour {
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
pub fn picture(s: Sample, sky: Colour, hills: Colour, p: [f32; 4], seed: i32) -> Colour {
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
