//! Clouds of known scenes, and clouds of any numbers.

use farpoint_obstacle_grid::{Class, HEIGHT_STEP, Lens, ObstacleGrid, Point, Seen, SensorPose, Settings};
use proptest::prelude::*;

const SIDE: usize = 160;
const SETTINGS: Settings = Settings {
    side: SIDE,
    cell: 0.05,
    clearance: 0.04,
    height: 1.1,
    drop: 0.15,
    slope: 0.01,
    low_ray: 0.15,
    near_points: 10.0,
    least_points: 2.0,
    confirm: false,
};
/// Optical axes (z forward, x right, y down) to REP-103, looking ahead.
const AHEAD: [f32; 9] = [0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0];
const WIDTH: usize = 322;
const HEIGHT: usize = 240;
const CAMERA: [f64; 4] = [160.0, 160.0, 160.5, 119.5];
const HIGH: f32 = 0.9;

fn pose() -> SensorPose {
    SensorPose::new(AHEAD, [0.1, 0.0, HIGH]).unwrap()
}

fn class_at(grid: &ObstacleGrid, x: f32, y: f32) -> u8 {
    let cell = |v: f32| ((v / SETTINGS.cell) + SIDE as f32 / 2.0).floor() as usize;
    grid.classes()[cell(y) * SIDE + cell(x)]
}

/// The depth image of a scene: the distance along x to the first surface of a ray from (0.1, 0, 0.9) along (1, y, z).
fn image(depth: impl Fn(f32, f32) -> f32) -> Vec<f32> {
    (0..HEIGHT)
        .flat_map(|v| (0..WIDTH).map(move |u| (u, v)))
        .map(|(u, v)| {
            let left = -((u as f64 - CAMERA[2]) / CAMERA[0]) as f32;
            let up = -((v as f64 - CAMERA[3]) / CAMERA[1]) as f32;
            depth(left, up)
        })
        .collect()
}

/// The depth at which a ray meets a level.
fn level(up: f32, z: f32) -> f32 {
    if up < 0.0 { (z - HIGH) / up } else { f32::INFINITY }
}

fn look(depth: &[f32]) -> (ObstacleGrid, Seen) {
    let mut grid = ObstacleGrid::new(SETTINGS).unwrap();
    let lens = Lens::new(WIDTH, HEIGHT, CAMERA).unwrap();
    let seen = grid.look_at_image(depth, &lens, &pose(), [0, 0]);
    (grid, seen)
}

fn height_at(grid: &ObstacleGrid, x: f32, y: f32) -> f32 {
    let cell = |v: f32| ((v / SETTINGS.cell) + SIDE as f32 / 2.0).floor() as usize;
    f32::from(grid.heights()[cell(y) * SIDE + cell(x)]) * HEIGHT_STEP
}

#[test]
fn a_free_cell_is_known_as_far_up_as_the_camera_looks() {
    let (grid, _) = look(&image(|_, up| level(up, 0.0)));
    // 119.5 pixels of 160 above the middle: 0.747 m more with each metre.
    for x in [1.52, 2.02, 3.02] {
        let top = HIGH + 0.747 * (x - 0.1);
        assert!((height_at(&grid, x, 0.02) - top).abs() < 0.05, "{x}: {}", height_at(&grid, x, 0.02));
    }
}

#[test]
fn an_obstacle_is_gone_when_its_lowest_part_is() {
    // A wall, a box of 12 cm, and a board from 0.6 m up.
    let depth = |left: f32, up: f32| {
        let wall = if left > 0.5 { 1.92 } else { f32::INFINITY };
        let low = if left < -0.5 && up * 1.92 + HIGH < 0.12 { 1.92 } else { f32::INFINITY };
        let board = if left.abs() < 0.3 && up * 1.92 + HIGH > 0.6 { 1.92 } else { f32::INFINITY };
        level(up, 0.0).min(wall).min(low).min(board)
    };
    let (grid, _) = look(&image(depth));
    for (y, top) in [(1.52, 0.2), (-1.52, 0.14), (0.02, 0.75)] {
        assert_eq!(class_at(&grid, 2.02, y), Class::Occupied as u8, "{y}");
        assert!((height_at(&grid, 2.02, y) - top).abs() < 0.05, "{y}: {}", height_at(&grid, 2.02, y));
    }
}

#[test]
fn a_bare_floor_is_free_as_far_as_it_is_seen() {
    let (grid, seen) = look(&image(|_, up| level(up, 0.0)));
    for x in [1.5, 2.0, 3.0, 3.9] {
        assert_eq!(class_at(&grid, x, 0.0), Class::Free as u8, "{x}");
    }
    assert_eq!(class_at(&grid, 0.5, 0.0), Class::Unknown as u8);
    assert_eq!(class_at(&grid, -1.0, 0.0), Class::Unknown as u8);
    assert_eq!(class_at(&grid, 1.5, 3.0), Class::Unknown as u8);
    assert_eq!((seen.occupied, seen.drop_offs), (0, 0));
    // No gaps between the rows of the image, although they are farther apart than cells.
    let gaps = (30..79).filter(|i| class_at(&grid, *i as f32 * 0.05 + 0.02, 0.3) == 0).count();
    assert_eq!(gaps, 0);
}

#[test]
fn a_wall_is_occupied_and_what_is_behind_it_unknown() {
    let (grid, seen) = look(&image(|_, up| level(up, 0.0).min(2.02 - 0.1)));
    assert_eq!(class_at(&grid, 2.02, 0.5), Class::Occupied as u8);
    assert_eq!(class_at(&grid, 1.8, 0.5), Class::Free as u8);
    assert_eq!(class_at(&grid, 2.5, 0.5), Class::Unknown as u8);
    assert!((60..120).contains(&seen.occupied), "{seen:?}");
}

#[test]
fn what_hangs_above_the_robot_is_passed_under_and_what_is_low_is_driven_over() {
    // A beam from 1.2 m up at 2 m, and a 3 cm sill at 1.5 m.
    let beam = |up: f32| if HIGH + up * 1.9 > 1.2 { 1.9 } else { f32::INFINITY };
    let sill = |up: f32| if (1.4..1.5).contains(&level(up, 0.03)) { level(up, 0.03) } else { f32::INFINITY };
    let (_, seen) = look(&image(|_, up| level(up, 0.0).min(beam(up)).min(sill(up))));
    assert_eq!((seen.occupied, seen.drop_offs), (0, 0));
}

#[test]
fn a_missing_floor_is_a_drop_off() {
    // Steps down at 2 m: what is behind lies 0.6 m lower.
    let depth = image(|_, up| {
        let upper = level(up, 0.0);
        if upper < 1.9 { upper } else { level(up, -0.6) }
    });
    let (grid, seen) = look(&depth);
    assert_eq!(class_at(&grid, 1.8, 0.0), Class::Free as u8);
    assert_eq!(class_at(&grid, 2.2, 0.0), Class::DropOff as u8);
    assert_eq!(class_at(&grid, 2.22, 0.4), Class::DropOff as u8);
    assert!(seen.drop_offs > 300 && seen.occupied == 0, "{seen:?}");
}

#[test]
fn single_points_in_the_air_are_noise_near_the_sensor() {
    let noise: Point = [0.0, 0.4, 1.0, 0.0];
    let mut grid = ObstacleGrid::new(SETTINGS).unwrap();
    let seen = grid.look_at_points(&[noise; 9], &pose(), [0, 0]);
    assert_eq!(seen.occupied, 0);
    assert_eq!(grid.look_at_points(&[noise; 10], &pose(), [0, 0]).occupied, 1);
    let far: Point = [0.0, 0.4, 3.0, 0.0];
    assert_eq!(grid.look_at_points(&[far; 2], &pose(), [0, 0]).occupied, 1);
}

#[test]
fn where_asked_an_obstacle_counts_once_a_second_cloud_has_it() {
    let point: Point = [0.0, 0.4, 2.0, 0.0];
    let mut grid = ObstacleGrid::new(Settings { confirm: true, ..SETTINGS }).unwrap();
    // The first cloud of all is believed.
    assert_eq!(grid.look_at_points(&[point; 10], &pose(), [0, 0]).occupied, 1);
    assert_eq!(grid.look_at_points(&[], &pose(), [0, 0]).occupied, 0);
    assert_eq!(grid.look_at_points(&[point; 10], &pose(), [0, 0]).occupied, 0);
    assert_eq!(grid.look_at_points(&[point; 10], &pose(), [0, 0]).occupied, 1);
    // The grid has moved by three cells, and with it the place of what stands still.
    let moved: Point = [0.0, 0.4, 1.85, 0.0];
    assert_eq!(grid.look_at_points(&[moved; 10], &pose(), [3, 0]).occupied, 1);
    assert_eq!(grid.look_at_points(&[moved; 10], &pose(), [3, 0]).occupied, 0);
}

#[test]
fn an_image_and_its_points_say_the_same() {
    let depth = image(|left, up| level(up, 0.0).min(2.0 + left.sin()));
    let points: Vec<Point> = depth
        .iter()
        .enumerate()
        .map(|(i, z)| {
            let ray = |pixel: usize, focal: f64, centre: f64| ((pixel as f64 - centre) / focal) as f32;
            let (x, y) = (ray(i % WIDTH, CAMERA[0], CAMERA[2]), ray(i / WIDTH, CAMERA[1], CAMERA[3]));
            [x * z, y * z, *z, f32::NAN]
        })
        .collect();
    let (by_image, seen) = look(&depth);
    let mut by_points = ObstacleGrid::new(SETTINGS).unwrap();
    assert_eq!(by_points.look_at_points(&points, &pose(), [0, 0]), seen);
    let differ = by_image.classes().iter().zip(by_points.classes()).filter(|(a, b)| a != b).count();
    // Rounding may put a point on the other side of an edge.
    assert!(differ < 20, "{differ}");
}

#[test]
fn refuses_a_pose_that_is_none() {
    assert!(SensorPose::new([0.0; 9], [0.0; 3]).is_none());
    assert!(SensorPose::new(AHEAD, [f32::NAN, 0.0, 0.0]).is_none());
}

fn any_number() -> impl Strategy<Value = f32> {
    prop_oneof![
        6 => -6.0f32..6.0,
        1 => any::<f32>(),
        1 => prop_oneof![Just(f32::NAN), Just(f32::INFINITY), Just(f32::NEG_INFINITY), Just(0.0), Just(-0.0)],
        1 => prop_oneof![Just(f32::MAX), Just(f32::MIN), Just(1e-40), Just(4.0), Just(-4.0)],
    ]
}

proptest! {
    #[test]
    fn takes_any_numbers(
        points in prop::collection::vec(prop::array::uniform4(any_number()), 0..200),
        position in prop::array::uniform3(-10f32..10.0),
        shift in prop::array::uniform2(any::<i32>()),
        confirm in any::<bool>(),
        side in 1usize..40,
    ) {
        let mut grid = ObstacleGrid::new(Settings { side: side * 2, confirm, ..SETTINGS }).unwrap();
        let pose = SensorPose::new(AHEAD, position).unwrap();
        for _ in 0..2 {
            let seen = grid.look_at_points(&points, &pose, shift);
            let count = |class: Class| grid.classes().iter().filter(|c| **c == class as u8).count() as u32;
            prop_assert_eq!(seen.free, count(Class::Free));
            prop_assert_eq!(seen.occupied, count(Class::Occupied));
            prop_assert_eq!(seen.drop_offs, count(Class::DropOff));
        }
        let depth: Vec<f32> = points.iter().flatten().copied().take(points.len() / 3 * 3).collect();
        if let Some(lens) = Lens::new(3, depth.len() / 3, [2.0, 2.0, 1.0, 1.0]) {
            let _ = grid.look_at_image(&depth, &lens, &pose, shift);
        }
    }

    #[test]
    fn the_order_of_points_does_not_matter(
        points in prop::collection::vec(prop::array::uniform4(any_number()), 0..100),
    ) {
        let (mut one, mut other) = (ObstacleGrid::new(SETTINGS).unwrap(), ObstacleGrid::new(SETTINGS).unwrap());
        let reversed: Vec<Point> = points.iter().rev().copied().collect();
        prop_assert_eq!(one.look_at_points(&points, &pose(), [0, 0]), other.look_at_points(&reversed, &pose(), [0, 0]));
        prop_assert_eq!(one.classes(), other.classes());
    }
}
