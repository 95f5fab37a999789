//! The world as the camera receives it once: materials, and flat convex faces fixed to rigid bodies.
//!
//! Layout of the buffer, all `f32`:
//! header `[version, bodies, materials, faces, lamp spacing in metres]`, then 16 numbers a material, then
//! 24 numbers a face (see `Material::read` and `Face::read`). Whole numbers are stored as floats.

use core::fmt;
use core::ops::Range;

pub const VERSION: f32 = 1.0;
pub const HEADER_LENGTH: usize = 5;
pub const MATERIAL_LENGTH: usize = 16;
pub const FACE_LENGTH: usize = 24;
/// Surfaces are numbered in 32-bit lanes, and the buffers of one frame must stay small.
const MAX_FACES: usize = 1 << 17;
/// Faces that are culled together: two boxes, which usually stand side by side.
const GROUP_SIZE: usize = 12;

/// Why a scene or a camera was refused.
#[derive(Debug, Clone, PartialEq)]
pub enum SceneError {
    Version(f32),
    Length { expected: usize, actual: usize },
    Count { what: &'static str, value: f32 },
    NotFinite { offset: usize },
    Index { face: usize, what: &'static str, value: f32 },
    Degenerate { face: usize },
    TextureKind { material: usize, value: f32 },
    Camera { what: &'static str, value: f64 },
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Version(v) => write!(f, "scene: version {v} is not {VERSION}"),
            Self::Length { expected, actual } => {
                write!(f, "scene: {actual} numbers where {expected} were announced")
            }
            Self::Count { what, value } => write!(f, "scene: {value} is no number of {what}"),
            Self::NotFinite { offset } => write!(f, "scene: number {offset} is not finite"),
            Self::Index { face, what, value } => {
                write!(f, "scene: face {face}: {what} {value} does not exist")
            }
            Self::Degenerate { face } => write!(f, "scene: face {face} has no area"),
            Self::TextureKind { material, value } => {
                write!(f, "scene: material {material}: texture kind {value} does not exist")
            }
            Self::Camera { what, value } => write!(f, "camera: {what} may not be {value}"),
        }
    }
}

/// Procedural textures; the numbers are the wire values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TextureKind {
    /// `first`.
    Flat = 0,
    /// Squares of side p0, alternately `first` and `second`.
    Checker = 1,
    /// Tiles p0 × p1 of `first`, tinted one by one, joints p2 wide of `second`; each row shifted by p3 tiles.
    Tile = 2,
    /// Stripes of period p0, a fraction p1 of it `second`; p2 turns them from across u (0) to across v (1).
    Stripes = 3,
    /// Cells of side p0 mixed at random between `first` and `second`.
    Grain = 4,
    /// Lines of height p0 that look like print: ink `second` on `first`.
    Text = 5,
    /// A row of book spines about p0 wide and up to p1 high before a back wall of `first`.
    Books = 6,
    /// Streaks along u, p0 wide, between `first` and `second`.
    Wood = 7,
    /// `first`, its brightness being u: smooth shading across a mesh.
    Smooth = 8,
    /// A landscape p0 wide and p1 high: sky `first`, hills `second`.
    Picture = 9,
}

impl TextureKind {
    const ALL: [Self; 10] = [
        Self::Flat,
        Self::Checker,
        Self::Tile,
        Self::Stripes,
        Self::Grain,
        Self::Text,
        Self::Books,
        Self::Wood,
        Self::Smooth,
        Self::Picture,
    ];
}

#[derive(Debug, Clone)]
pub struct Material {
    pub kind: TextureKind,
    /// Reflectance, red green blue, 0 to 1.
    pub first: [f32; 3],
    pub second: [f32; 3],
    pub parameters: [f32; 4],
    pub seed: i32,
    /// Share of the surface on which stereo matching fails for want of texture or because of gloss.
    pub unmatched: f32,
    /// 1 for what shines by itself: lamps, screens, windows.
    pub emission: f32,
}

impl Material {
    fn read(index: usize, n: &[f32]) -> Result<Self, SceneError> {
        let kind = whole(n[0])
            .and_then(|k| TextureKind::ALL.get(k).copied())
            .ok_or(SceneError::TextureKind { material: index, value: n[0] })?;
        Ok(Self {
            kind,
            first: [n[1], n[2], n[3]],
            second: [n[4], n[5], n[6]],
            parameters: [n[7], n[8], n[9], n[10]],
            seed: n[11] as i32,
            unmatched: n[12].clamp(0.0, 1.0),
            emission: n[13].clamp(0.0, 1.0),
        })
    }
}

/// A convex polygon of three or four corners, counter-clockwise seen from its front, in its body's frame.
#[derive(Debug, Clone)]
pub struct Face {
    pub body: usize,
    pub material: usize,
    pub corners: [[f64; 3]; 4],
    pub corner_count: usize,
    /// Unit normal, and its product with any point of the face.
    pub normal: [f64; 3],
    pub offset: f64,
    /// Texture coordinates in metres as affine functions of the position: u = xyz·position + w.
    pub u: [f64; 4],
    pub v: [f64; 4],
}

impl Face {
    fn read(index: usize, n: &[f32], bodies: usize, materials: usize) -> Result<Self, SceneError> {
        let pick = |what: &'static str, value: f32, count: usize| {
            whole(value).filter(|&i| i < count).ok_or(SceneError::Index { face: index, what, value })
        };
        let body = pick("body", n[0], bodies)?;
        let material = pick("material", n[1], materials)?;
        let corner_count = pick("corner", n[2] - 1.0, 4)? + 1;
        if corner_count < 3 {
            return Err(SceneError::Index { face: index, what: "corner count", value: n[2] });
        }
        let wide = |i: usize| f64::from(n[i]);
        let corners: [[f64; 3]; 4] =
            core::array::from_fn(|c| core::array::from_fn(|axis| wide(3 + 3 * c + axis)));
        let area = cross(sub(corners[1], corners[0]), sub(corners[2], corners[0]));
        let length = dot(area, area).sqrt();
        if length < 1e-10 {
            return Err(SceneError::Degenerate { face: index });
        }
        let normal = area.map(|a| a / length);
        Ok(Self {
            body,
            material,
            corners,
            corner_count,
            normal,
            offset: dot(normal, corners[0]),
            u: core::array::from_fn(|i| wide(15 + i)),
            v: core::array::from_fn(|i| wide(19 + i)),
        })
    }
}

/// Neighbouring faces of one body and a sphere about them: culled together.
#[derive(Debug)]
pub struct Group {
    pub body: usize,
    pub faces: Range<usize>,
    /// In the body's frame.
    pub centre: [f64; 3],
    pub radius: f64,
}

impl Group {
    fn new(faces: &[Face], range: Range<usize>) -> Self {
        let members = &faces[range.clone()];
        let corners = || members.iter().flat_map(|face| &face.corners[..face.corner_count]);
        let bound = |axis: usize, pick: fn(f64, f64) -> f64| {
            corners().map(|corner| corner[axis]).reduce(pick).unwrap_or(0.0)
        };
        let centre = core::array::from_fn(|axis| (bound(axis, f64::min) + bound(axis, f64::max)) / 2.0);
        let radius =
            corners().map(|&corner| dot(sub(corner, centre), sub(corner, centre)).sqrt()).fold(0.0, f64::max);
        Self { body: members[0].body, faces: range, centre, radius }
    }
}

#[derive(Debug)]
pub struct Scene {
    pub materials: Vec<Material>,
    /// Sorted by body.
    pub faces: Vec<Face>,
    pub groups: Vec<Group>,
    pub body_count: usize,
    /// Distance between neighbouring ceiling lamps, along x and y.
    pub lamp_spacing: f32,
}

impl Scene {
    /// Reads and checks the whole buffer.
    pub fn read(numbers: &[f32]) -> Result<Self, SceneError> {
        if let Some(offset) = numbers.iter().position(|n| !n.is_finite()) {
            return Err(SceneError::NotFinite { offset });
        }
        if numbers.len() < HEADER_LENGTH {
            return Err(SceneError::Length { expected: HEADER_LENGTH, actual: numbers.len() });
        }
        if numbers[0] != VERSION {
            return Err(SceneError::Version(numbers[0]));
        }
        let count = |what: &'static str, value: f32, limit: usize| {
            whole(value).filter(|&n| n <= limit).ok_or(SceneError::Count { what, value })
        };
        let bodies = count("bodies", numbers[1], 4096)?;
        let materials = count("materials", numbers[2], 4096)?;
        let faces = count("faces", numbers[3], MAX_FACES)?;
        if numbers[4] <= 0.0 {
            return Err(SceneError::Count { what: "metres between lamps", value: numbers[4] });
        }
        let expected = HEADER_LENGTH + materials * MATERIAL_LENGTH + faces * FACE_LENGTH;
        if numbers.len() != expected {
            return Err(SceneError::Length { expected, actual: numbers.len() });
        }
        let (material_numbers, face_numbers) = numbers[HEADER_LENGTH..].split_at(materials * MATERIAL_LENGTH);
        let material_list: Vec<_> = material_numbers
            .chunks_exact(MATERIAL_LENGTH)
            .enumerate()
            .map(|(index, n)| Material::read(index, n))
            .collect::<Result<_, _>>()?;
        let mut face_list: Vec<_> = face_numbers
            .chunks_exact(FACE_LENGTH)
            .enumerate()
            .map(|(index, n)| Face::read(index, n, bodies, materials))
            .collect::<Result<_, _>>()?;
        face_list.sort_by_key(|face| face.body);
        let mut groups = Vec::new();
        let mut first = 0;
        for body in face_list.chunk_by(|a, b| a.body == b.body) {
            for start in (0..body.len()).step_by(GROUP_SIZE) {
                let end = (start + GROUP_SIZE).min(body.len());
                groups.push(Group::new(&face_list, first + start..first + end));
            }
            first += body.len();
        }
        Ok(Self {
            materials: material_list,
            faces: face_list,
            groups,
            body_count: bodies,
            lamp_spacing: numbers[4],
        })
    }
}

fn whole(value: f32) -> Option<usize> {
    ((0.0..16_777_216.0).contains(&value) && value.fract() == 0.0).then_some(value as usize)
}

pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
