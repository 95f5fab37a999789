//! The camera: scene in, frame out. All buffers are made once.

use crate::config::Config;
use crate::pose::{POSE_LENGTH, Pose};
use crate::raster::Raster;
use crate::scene::{Scene, SceneError};
use crate::shade::Shader;
use crate::stereo::{Frame, ground_truth, measure};

pub struct Camera {
    config: Config,
    scene: Scene,
    raster: Raster,
    pub frame: Frame,
    occluded: Vec<u32>,
    bodies: Vec<Pose>,
    /// Written by the caller before each frame: the optical frame's pose in the world, then each body's.
    pub poses: Vec<f64>,
}

impl Camera {
    /// Reads the scene (see `scene`) and the configuration (see `config`).
    pub fn new(scene: &[f32], config: &[f64]) -> Result<Self, SceneError> {
        let config = Config::read(config)?;
        let scene = Scene::read(scene)?;
        let identity = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
        let count = scene.body_count;
        Ok(Self {
            raster: Raster::new(&config, &scene),
            frame: Frame::new(&config),
            occluded: vec![0; config.width],
            bodies: vec![Pose::read(&identity); count],
            poses: identity.repeat(count + 1),
            config,
            scene,
        })
    }

    /// Draws a frame from `poses`: the images, and `with_points` the points too. The same number gives the same noise. Ground
    /// truth has no faults at all.
    pub fn render(&mut self, frame_number: u32, without_faults: bool, with_points: bool) {
        let camera = Pose::read(&self.poses);
        for (body, numbers) in self.bodies.iter_mut().zip(self.poses[POSE_LENGTH..].chunks_exact(POSE_LENGTH))
        {
            *body = Pose::read(numbers);
        }
        self.raster.draw(&self.config, &self.scene, &camera, &self.bodies);
        let Self { config, scene, raster, frame, occluded, .. } = self;
        let shader = Shader::new(config, scene, &camera, raster);
        if with_points {
            frame.points.resize(4 * config.width * config.height, 0);
        }
        match (without_faults, with_points) {
            (false, false) => measure::<false>(config, raster, &shader, frame_number, frame, occluded),
            (false, true) => measure::<true>(config, raster, &shader, frame_number, frame, occluded),
            (true, false) => ground_truth::<false>(config, raster, &shader, frame),
            (true, true) => ground_truth::<true>(config, raster, &shader, frame),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{FACE_LENGTH, HEADER_LENGTH, MATERIAL_LENGTH, VERSION};

    const WIDTH: usize = 480;
    const CONFIG: [f64; 14] =
        [480.0, 480.0, 240.0, 240.0, 239.5, 239.5, 0.075, 0.0015, 0.03125, 0.3, 15.0, 0.0, 1.0, 7.0];

    /// Quads that face the camera, which looks along z with y down: (left, right, top, bottom, depth).
    fn scene(quads: &[[f32; 5]]) -> Vec<f32> {
        let mut numbers = vec![VERSION, 1.0, 1.0, quads.len() as f32, 3.0];
        let mut material = [0.0; MATERIAL_LENGTH];
        material[1..4].copy_from_slice(&[0.5, 0.4, 0.3]);
        numbers.extend(material);
        for &[left, right, top, bottom, depth] in quads {
            let mut face = [0.0; FACE_LENGTH];
            face[2] = 4.0;
            // Counter-clockwise for the camera, whose y axis points down.
            let corners = [[left, bottom], [right, bottom], [right, top], [left, top]];
            for (i, [x, y]) in corners.into_iter().enumerate() {
                face[3 + 3 * i..6 + 3 * i].copy_from_slice(&[x, y, depth]);
            }
            face[15] = 1.0;
            face[20] = 1.0;
            numbers.extend(face);
        }
        assert_eq!(numbers.len(), HEADER_LENGTH + MATERIAL_LENGTH + FACE_LENGTH * quads.len());
        numbers
    }

    fn depths(camera: &Camera) -> Vec<f32> {
        camera.frame.depth.iter().map(|&bits| f32::from_bits(bits)).collect()
    }

    fn wall(depth: f32) -> [f32; 5] {
        [-100.0, 100.0, -100.0, 100.0, depth]
    }

    #[test]
    fn ground_truth_of_a_wall_is_exact_and_unprojects() {
        let mut camera = Camera::new(&scene(&[wall(2.0)]), &CONFIG).unwrap();
        camera.render(0, true, true);
        for (pixel, point) in camera.frame.points.chunks_exact(4).enumerate() {
            let [x, y, z] = [0, 1, 2].map(|i| f32::from_bits(point[i]));
            let (column, row) = ((pixel % WIDTH) as f32, (pixel / WIDTH) as f32);
            assert!((z - 2.0).abs() < 1e-5);
            assert!((x - (column - 239.5) / 240.0 * 2.0).abs() < 1e-5);
            assert!((y - (row - 239.5) / 240.0 * 2.0).abs() < 1e-5);
        }
    }

    #[test]
    fn a_face_covers_exactly_the_pixels_whose_centres_it_contains() {
        // Columns 144 to 335 and rows 192 to 287 at two metres.
        let at = |pixel: f32| (pixel - 239.5) / 240.0 * 2.0;
        let quad = [at(143.5), at(335.5), at(191.5), at(287.5), 2.0];
        let mut camera = Camera::new(&scene(&[quad]), &CONFIG).unwrap();
        camera.render(0, true, true);
        for (pixel, depth) in depths(&camera).into_iter().enumerate() {
            let (column, row) = (pixel % WIDTH, pixel / WIDTH);
            let inside = (144..=335).contains(&column) && (192..=287).contains(&row);
            assert_eq!(depth > 0.0, inside, "pixel {column}, {row}");
        }
    }

    #[test]
    fn noise_grows_with_the_square_of_depth() {
        for depth in [1.0f32, 2.0, 4.0, 8.0] {
            let mut camera = Camera::new(&scene(&[wall(depth)]), &CONFIG).unwrap();
            camera.render(3, false, true);
            let measured: Vec<f32> = depths(&camera).into_iter().filter(|&z| z > 0.0).collect();
            assert!(measured.len() > 200_000);
            let count = measured.len() as f64;
            let mean = measured.iter().map(|&z| f64::from(z)).sum::<f64>() / count;
            let variance = measured.iter().map(|&z| (f64::from(z) - mean).powi(2)).sum::<f64>() / count;
            // The matcher's step adds its own variance, a twelfth of its square.
            let step: f64 = 0.03125 / (240.0 * 0.075);
            let expected = (0.0015f64.powi(2) + step * step / 12.0).sqrt();
            let sigma = variance.sqrt() / f64::from(depth * depth);
            assert!((sigma / expected - 1.0).abs() < 0.05, "at {depth} m: {sigma} for {expected}");
            assert!((mean - f64::from(depth)).abs() < 0.01 * f64::from(depth));
        }
    }

    #[test]
    fn what_the_right_imager_cannot_see_is_a_hole_left_of_the_object() {
        let box_front = [-0.3, 0.3, -0.3, 0.3, 1.0];
        let mut camera = Camera::new(&scene(&[wall(4.0), box_front]), &CONFIG).unwrap();
        camera.render(0, false, true);
        // Disparities: 18 px at 1 m, 4.5 px at 4 m; the object begins at column 168.
        let row = &depths(&camera)[240 * WIDTH..241 * WIDTH];
        assert!(row[155..165].iter().all(|&z| z == 0.0), "{:?}", &row[150..172]);
        assert!(row[140..150].iter().all(|&z| (z - 4.0).abs() < 0.3));
        assert!(row[320..330].iter().all(|&z| (z - 4.0).abs() < 0.3));
        assert!(row[180..300].iter().all(|&z| (z - 1.0).abs() < 0.02));
    }

    #[test]
    fn images_without_points_are_the_same_images() {
        let scene = scene(&[wall(4.0), [-0.3, 0.3, -0.3, 0.3, 1.0]]);
        for truth in [false, true] {
            let [mut with, mut without] = [(); 2].map(|()| Camera::new(&scene, &CONFIG).unwrap());
            with.render(7, truth, true);
            without.render(7, truth, false);
            assert!(without.frame.points.is_empty());
            assert!(with.frame.depth == without.frame.depth);
            assert!(with.frame.colour[..WIDTH * WIDTH] == without.frame.colour[..WIDTH * WIDTH]);
        }
    }

    #[test]
    fn out_of_range_is_invalid() {
        for depth in [0.2f32, 25.0] {
            let mut camera = Camera::new(&scene(&[wall(depth)]), &CONFIG).unwrap();
            camera.render(0, false, true);
            assert!(depths(&camera).iter().all(|&z| z == 0.0));
            assert!(camera.frame.points.chunks_exact(4).all(|p| p[..3] == [0x7fc0_0000; 3]));
        }
    }

    #[test]
    fn a_frame_is_a_function_of_seed_and_number() {
        let frame = |seed: f64, number: u32| {
            let mut config = CONFIG;
            config[13] = seed;
            let mut camera = Camera::new(&scene(&[wall(2.0)]), &config).unwrap();
            camera.render(number ^ 1, false, true);
            camera.render(number, false, true);
            camera.frame.points
        };
        assert!(frame(1.0, 5) == frame(1.0, 5));
        assert!(frame(1.0, 5) != frame(1.0, 6));
        assert!(frame(1.0, 5) != frame(2.0, 5));
    }

    #[test]
    fn a_face_through_the_camera_plane_is_drawn_to_the_edge() {
        // A floor half a metre below the camera, from 50 m behind it to 50 m before it.
        let mut numbers = scene(&[wall(1.0)]);
        let corners = [-9.0, 0.5, -50.0, 9.0, 0.5, -50.0, 9.0, 0.5, 50.0, -9.0, 0.5, 50.0];
        numbers[HEADER_LENGTH + MATERIAL_LENGTH + 3..][..12].copy_from_slice(&corners);
        let mut camera = Camera::new(&numbers, &CONFIG).unwrap();
        camera.render(0, true, true);
        for (row, z) in depths(&camera).iter().skip(240).step_by(WIDTH).enumerate() {
            let expected = 0.5 * 240.0 / (row as f32 - 239.5);
            let visible = expected > 0.0 && expected <= 50.0;
            let wanted = if visible { expected } else { 0.0 };
            assert!((z - wanted).abs() <= 1e-4 * wanted, "row {row}: {z} for {wanted}");
        }
    }

    #[test]
    fn bad_scenes_are_refused() {
        let good = scene(&[wall(2.0)]);
        let with = |offset: usize, value: f32| {
            let mut numbers = good.clone();
            numbers[offset] = value;
            Camera::new(&numbers, &CONFIG).map(|_| ()).unwrap_err()
        };
        let face = HEADER_LENGTH + MATERIAL_LENGTH;
        assert_eq!(with(0, 9.0), SceneError::Version(9.0));
        assert!(matches!(with(3, 2.0), SceneError::Length { .. }));
        assert!(matches!(with(3, 1e9), SceneError::Count { what: "faces", .. }));
        assert!(matches!(with(7, f32::NAN), SceneError::NotFinite { offset: 7 }));
        assert!(matches!(with(HEADER_LENGTH, 99.0), SceneError::TextureKind { .. }));
        assert!(matches!(with(face, 1.0), SceneError::Index { what: "body", .. }));
        assert!(matches!(with(face + 1, -1.0), SceneError::Index { what: "material", .. }));
        assert!(matches!(with(face + 2, 2.0), SceneError::Index { what: "corner count", .. }));
        let mut flat = good.clone();
        flat[face + 3..face + 15].fill(0.0);
        assert!(matches!(Camera::new(&flat, &CONFIG), Err(SceneError::Degenerate { face: 0 })));
        assert!(Camera::new(&good[..3], &CONFIG).is_err());
        let mut odd = CONFIG;
        odd[0] = 482.0;
        assert!(matches!(Camera::new(&good, &odd), Err(SceneError::Camera { what: "width", .. })));
    }
}
