//! From faces to a visibility buffer: for each pixel the nearest face and the inverse of its depth.
//!
//! Inverse depth is an affine function of the pixel on any plane, so a row of a face costs one comparison
//! and one store for four pixels. Colour comes later and only for what is seen.

use crate::config::Config;
use crate::pose::Pose;
use crate::scene::{Face, Scene, cross, dot};
use crate::simd::{F32x4, I32x4, ramp};

/// No face at this pixel.
pub const NOTHING: u32 = u32::MAX;
/// Rows of a face that passes through the camera's plane are bounded where it comes this near (metres).
const NEAR: f64 = 1e-3;

/// An affine function of the pixel: `[0] · column + [1] · row + [2]`.
pub type PixelAffine = [f32; 3];

/// One visible face, as the shader needs it.
#[derive(Debug, Clone, Copy)]
pub struct Surface {
    pub material: usize,
    /// Inverse depth, 1/m.
    pub inverse_depth: PixelAffine,
    /// Distance of the camera from the face's plane, metres.
    pub distance: f32,
    /// Texture coordinates, metres: depth times the function, plus the constant.
    pub u: (PixelAffine, f32),
    pub v: (PixelAffine, f32),
    /// The face's normal in the world.
    pub normal: [f32; 3],
}

/// Half a row's constraint from one edge of a face: pixels left or right of `slope · ray_y + intercept`.
#[derive(Clone, Copy)]
enum Edge {
    LeftOf {
        slope: f64,
        intercept: f64,
    },
    RightOf {
        slope: f64,
        intercept: f64,
    },
    /// An edge along the row: inside where `slope · ray_y + intercept` is not above zero.
    Along {
        slope: f64,
        intercept: f64,
    },
}

pub struct Raster {
    pub width: usize,
    pub height: usize,
    /// Inverse depth in 1/m, row by row; 0 where there is nothing.
    pub inverse_depth: Vec<f32>,
    /// Index into `surfaces`, or `NOTHING`.
    pub index: Vec<u32>,
    pub surfaces: Vec<Surface>,
}

impl Raster {
    pub fn new(config: &Config, scene: &Scene) -> Self {
        // Four spare words: the last vector of the last row may reach past its end.
        let pixels = config.width * config.height + 4;
        Self {
            width: config.width,
            height: config.height,
            inverse_depth: vec![0.0; pixels],
            index: vec![NOTHING; pixels],
            surfaces: Vec::with_capacity(scene.faces.len()),
        }
    }

    /// Draws all faces. `bodies` holds each body's pose in the world, `camera` the optical frame's.
    pub fn draw(&mut self, config: &Config, scene: &Scene, camera: &Pose, bodies: &[Pose]) {
        self.inverse_depth.fill(0.0);
        self.index.fill(NOTHING);
        self.surfaces.clear();
        let world_to_camera = camera.inverse();
        let mut body = usize::MAX;
        let mut to_camera = world_to_camera;
        let mut eye = [0.0; 3];
        for group in &scene.groups {
            if group.body != body {
                body = group.body;
                to_camera = world_to_camera.after(&bodies[body]);
                eye = to_camera.inverse().translation;
            }
            if !sphere_in_view(config, to_camera.apply(group.centre), group.radius) {
                continue;
            }
            for face in &scene.faces[group.faces.clone()] {
                let distance = dot(face.normal, eye) - face.offset;
                // Not behind the face, nor so nearly in its plane that it covers no pixel.
                if distance > 1e-5 {
                    self.draw_face(config, face, distance, &to_camera, &bodies[body]);
                }
            }
        }
    }

    #[inline(never)]
    fn draw_face(&mut self, config: &Config, face: &Face, distance: f64, to_camera: &Pose, body: &Pose) {
        let mut corners = [[0.0; 3]; 4];
        let count = face.corner_count;
        for (to, from) in corners.iter_mut().zip(&face.corners[..count]) {
            *to = to_camera.apply(*from);
        }
        let corners = &corners[..count];
        let Some((first_row, end_row)) = self.row_range(config, corners) else {
            return;
        };

        let mut edges = [Edge::Along { slope: 0.0, intercept: 0.0 }; 4];
        for (i, edge) in edges[..count].iter_mut().enumerate() {
            // The plane through the eye and the edge; rays inside the face are on its negative side.
            let side = cross(corners[i], corners[(i + 1) % count]);
            *edge = if side[0].abs() < 1e-9 * (side[1].abs() + side[2].abs()) {
                Edge::Along { slope: side[1], intercept: side[2] }
            } else {
                let slope = -config.fx * side[1] / side[0];
                let intercept = config.cx - config.fx * side[2] / side[0];
                if side[0] > 0.0 {
                    Edge::LeftOf { slope, intercept }
                } else {
                    Edge::RightOf { slope, intercept }
                }
            };
        }

        let surface = surface_of(config, face, distance, to_camera, body);
        let id = self.surfaces.len() as u32;
        let [step, per_row, at_origin] = surface.inverse_depth;
        let mut seen = false;
        for row in first_row..end_row {
            let ray_y = (row as f64 - config.cy) / config.fy;
            let (mut left, mut right) = (0.0f64, self.width as f64 - 1.0);
            for edge in &edges[..count] {
                match *edge {
                    Edge::LeftOf { slope, intercept } => right = right.min(slope * ray_y + intercept),
                    Edge::RightOf { slope, intercept } => left = left.max(slope * ray_y + intercept),
                    Edge::Along { slope, intercept } => {
                        if slope * ray_y + intercept > 0.0 {
                            right = -1.0;
                        }
                    }
                }
            }
            if right < left {
                continue;
            }
            let (first, end) = (left.ceil() as usize, right.floor() as usize + 1);
            if first >= end {
                continue;
            }
            seen = true;
            let at_zero = per_row * row as f32 + at_origin;
            let start = row * self.width;
            self.fill_span(start, first, end, step, at_zero, id);
        }
        if seen {
            self.surfaces.push(surface);
        }
    }

    /// Writes pixels `first..end` of the row that begins at `start`, where the face is the nearest so far.
    #[inline(never)]
    fn fill_span(&mut self, start: usize, first: usize, end: usize, step: f32, at_zero: f32, id: u32) {
        // Four words past the end are part of the row's slice so that whole vectors can be moved.
        let depths = &mut self.inverse_depth[start..start + end + 4];
        let ids = &mut self.index[start..start + end + 4];
        let (step, at_zero) = (F32x4::splat(step), F32x4::splat(at_zero));
        let id = I32x4::splat(id as i32);
        let mut x = first;
        while x < end {
            let depth = step * ramp(x as f32) + at_zero;
            let old = F32x4::load(&depths[x..]);
            let mut nearer = depth.gt(old);
            if x + 4 > end {
                nearer = nearer & I32x4::new(0, 1, 2, 3).lt(I32x4::splat((end - x) as i32));
            }
            if nearer.any() {
                depth.select(old, nearer).store(&mut depths[x..]);
                id.select(I32x4::load(&ids[x..]), nearer).store(&mut ids[x..]);
            }
            x += 4;
        }
    }

    /// Rows that a face may touch; `None` when it lies outside the picture.
    fn row_range(&self, config: &Config, corners: &[[f64; 3]]) -> Option<(usize, usize)> {
        let (left, right) = (-config.cx / config.fx, (self.width as f64 - config.cx) / config.fx);
        if corners.iter().all(|c| c[2] < NEAR)
            || corners.iter().all(|c| c[0] < left * c[2])
            || corners.iter().all(|c| c[0] > right * c[2])
        {
            return None;
        }
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut include = |ray_y: f64| {
            low = low.min(ray_y);
            high = high.max(ray_y);
        };
        for (i, corner) in corners.iter().enumerate() {
            let next = corners[(i + 1) % corners.len()];
            if corner[2] >= NEAR {
                include(corner[1] / corner[2]);
            }
            if (corner[2] >= NEAR) != (next[2] >= NEAR) {
                let t = (NEAR - corner[2]) / (next[2] - corner[2]);
                include((corner[1] + t * (next[1] - corner[1])) / NEAR);
            }
        }
        let first = (low * config.fy + config.cy).ceil().max(0.0);
        let end = (high * config.fy + config.cy).floor().min(self.height as f64 - 1.0) + 1.0;
        (first < end).then_some((first as usize, end as usize))
    }
}

/// A direction of the optical frame, times the ray through each pixel.
pub fn along_rays(config: &Config, direction: [f64; 3]) -> PixelAffine {
    let [x, y] = [direction[0] / config.fx, direction[1] / config.fy];
    [x as f32, y as f32, (direction[2] - x * config.cx - y * config.cy) as f32]
}

fn surface_of(config: &Config, face: &Face, distance: f64, to_camera: &Pose, body: &Pose) -> Surface {
    let texture = |f: &[f64; 4]| {
        let direction = to_camera.rotate([f[0], f[1], f[2]]);
        let constant = f[3] - dot(direction, to_camera.translation);
        (along_rays(config, direction), constant as f32)
    };
    // In the camera's frame the plane is normal·p = -distance, so 1/z = -(normal·ray)/distance.
    let plane = to_camera.rotate(face.normal).map(|n| -n / distance);
    Surface {
        material: face.material,
        inverse_depth: along_rays(config, plane),
        distance: distance as f32,
        u: texture(&face.u),
        v: texture(&face.v),
        normal: body.rotate(face.normal).map(|n| n as f32),
    }
}

/// Whether a sphere may be in the camera's view.
fn sphere_in_view(config: &Config, centre: [f64; 3], radius: f64) -> bool {
    if centre[2] < -radius {
        return false;
    }
    let outside = |along: f64, half: f64, focal: f64| {
        // Distance beyond the side plane through the eye, whose normal is (focal, -half).
        along.abs() * focal - centre[2] * half > radius * (focal * focal + half * half).sqrt()
    };
    let half_width = config.cx.max(config.width as f64 - config.cx);
    let half_height = config.cy.max(config.height as f64 - config.cy);
    !outside(centre[0], half_width, config.fx) && !outside(centre[1], half_height, config.fy)
}
