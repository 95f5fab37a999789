//! The order of symbols in a packet and the contexts they are coded with: one walk for coding and decoding.

mod blocks;
mod mask;
mod number;
mod plane;
mod rows;
mod wavefront;

use blocks::{BlockEdge, NO_BLOCK, code_blocks, code_points};
use mask::code_mask;
use number::{code_number, fold, unfold};
use plane::{Channel, PlaneTask, Side};
use wide::i16x8;

use crate::contexts::{ANCHOR, KIND, PATTERN};
use crate::rans::{Coder, Decoder, TileTokens, code_octaves};
use crate::tile::{ColourMode, Kind, LAST_TRANSFORMED, Pattern, Place, Plane, TILE, Tile};

/// A decoder finds a tile's masks and planes symbol by symbol; an encoder knows them, and finds many symbols at once.
pub trait TileCoder: Coder {
    /// Codes which pixels of the rows are valid.
    fn mask(&mut self, rows: &mut [u16; TILE], width: usize, height: usize);
    /// Codes a plane, gives pixels that are not valid what is predicted for them, and returns the lanes' activity.
    fn plane(&mut self, plane: &mut Plane, task: &PlaneTask) -> i16x8;
}

impl TileCoder for Decoder<'_> {
    fn mask(&mut self, rows: &mut [u16; TILE], width: usize, height: usize) {
        self.with_copy(|decoder| mask::walk(decoder, rows, width, height));
    }

    fn plane(&mut self, plane: &mut Plane, task: &PlaneTask) -> i16x8 {
        let [activity] = wavefront::decode([self], [plane], [task]);
        activity
    }
}

impl TileCoder for TileTokens {
    fn mask(&mut self, rows: &mut [u16; TILE], width: usize, height: usize) {
        if width == TILE && height == TILE {
            self.push_mask(mask::tokens(rows));
        } else {
            self.with_copy(|tokens| mask::walk(tokens, rows, width, height));
        }
    }

    #[inline(never)]
    fn plane(&mut self, plane: &mut Plane, task: &PlaneTask) -> i16x8 {
        rows::code(self, plane, task)
    }
}

/// The largest quantised inverse depth.
pub const MAX_DEPTH: i32 = 32_767;
/// Levels of a mean lie within ±this.
pub const MAX_DC: i32 = 16_383;

/// Kind of no tile.
const NO_KIND: usize = 3;

/// What a tile leaves to the one on its right.
#[derive(Clone, Copy)]
struct Edge {
    kind: usize,
    /// False where there is nothing to predict from.
    known: bool,
    /// By channel.
    sides: [Side; Channel::COUNT],
    blocks: [[BlockEdge; 2]; 3],
}

const NO_EDGE: Edge =
    Edge { kind: NO_KIND, known: false, sides: [[0; TILE]; Channel::COUNT], blocks: [[NO_BLOCK; 2]; 3] };

/// What the tiles of a packet know of those before them.
#[derive(Clone)]
pub struct Neighbours {
    left: Edge,
    pattern: usize,
    point: [i32; 3],
    /// Depth at the upper right corner of the last tile that is not empty.
    last_depth: Option<i16>,
    /// Of the last block of each plane.
    last_dc: [Option<i32>; 3],
    /// By channel, lane by lane: the size of the last residual.
    activity: [i16x8; Channel::COUNT],
}

impl Neighbours {
    /// At the beginning of a packet: nothing.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            left: NO_EDGE,
            pattern: 8,
            point: [0; 3],
            last_depth: None,
            last_dc: [None; 3],
            activity: [i16x8::ZERO; Channel::COUNT],
        }
    }
}

impl Default for Neighbours {
    fn default() -> Self {
        Self::new()
    }
}

/// Codes a tile that is known.
#[inline(always)]
pub fn code_tile<C: TileCoder>(
    coder: &mut C,
    tile: &mut Tile,
    near: &mut Neighbours,
    place: Place,
    mode: ColourMode,
) {
    const { assert!(!C::DECODES) };
    if code_head(coder, tile, near, place) {
        code_planes(coder, tile, near, mode);
        code_tail(coder, tile, near, mode, false);
    }
}

/// Codes which pixels of a tile there are. False where there are none: nothing follows then.
#[inline(always)]
pub fn code_head<C: TileCoder>(coder: &mut C, tile: &mut Tile, near: &mut Neighbours, place: Place) -> bool {
    if place.column == 0 {
        near.left = NO_EDGE;
    }
    coder.first_turn();
    let kind = coder.symbol(KIND + near.left.kind, tile.kind as u32);
    tile.kind = match kind {
        0 => Kind::Empty,
        1 => Kind::Full,
        _ => Kind::Mixed,
    };
    if tile.kind == Kind::Empty {
        tile.rows = [0; TILE];
        near.left = Edge { kind: 0, ..NO_EDGE };
        return false;
    }
    let pattern = coder.symbol(PATTERN + near.pattern, u32::from(tile.pattern.0));
    tile.pattern = Pattern(pattern as u8 & 7);
    near.pattern = usize::from(tile.pattern.0);
    code_mask(coder, tile);
    true
}

/// Codes a tile's planes, which follow its head.
#[inline(always)]
pub fn code_planes<C: TileCoder>(coder: &mut C, tile: &mut Tile, near: &mut Neighbours, mode: ColourMode) {
    for channel in Channel::of(mode) {
        let task = begin_plane(coder, tile, near, *channel);
        let activity = coder.plane(channel.plane_mut(tile), &task);
        end_plane(tile, near, *channel, &task, activity);
    }
}

/// Decodes the planes of a tile of each of two packets: side by side where their shapes are alike.
#[inline(always)]
pub fn decode_planes(
    [first, second]: [&mut Decoder<'_>; 2],
    [one, other]: [&mut Tile; 2],
    [near_one, near_other]: [&mut Neighbours; 2],
    mode: ColourMode,
) {
    for channel in Channel::of(mode) {
        let task = begin_plane(first, one, near_one, *channel);
        let other_task = begin_plane(second, other, near_other, *channel);
        let planes = [channel.plane_mut(one), channel.plane_mut(other)];
        let [activity, other_activity] = if task.is_like(&other_task) {
            wavefront::decode([first, second], planes, [&task, &other_task])
        } else {
            let [plane, other_plane] = planes;
            [first.plane(plane, &task), second.plane(other_plane, &other_task)]
        };
        end_plane(one, near_one, *channel, &task, activity);
        end_plane(other, near_other, *channel, &other_task, other_activity);
    }
}

/// Codes a tile's colours, which follow its planes. `last`: the packet's last tile, which an encoder need not know.
#[inline(always)]
pub fn code_tail<C: TileCoder>(
    coder: &mut C,
    tile: &mut Tile,
    near: &mut Neighbours,
    mode: ColourMode,
    last: bool,
) {
    near.left.kind = tile.kind as usize;
    near.left.known = true;
    match mode {
        ColourMode::None | ColourMode::Palette => {}
        _ if tile.pattern <= LAST_TRANSFORMED => code_blocks(coder, tile, near, mode, last),
        _ => code_points(coder, tile, near),
    }
}

/// What a plane's coding needs to know, and what stands in for surroundings where none are known.
#[inline(always)]
fn begin_plane<C: TileCoder>(coder: &mut C, tile: &Tile, near: &Neighbours, channel: Channel) -> PlaneTask {
    let known = near.left.known;
    let anchor = match channel {
        _ if known => 1,
        Channel::Depth => code_anchor(coder, first_valid::<C>(tile, channel), near.last_depth),
        Channel::Index => coder.raw(8, first_valid::<C>(tile, channel) - 1) as i16 + 1,
    };
    coder.first_turn();
    let height = tile.pattern.height();
    let side = &near.left.sides[channel as usize];
    PlaneTask {
        width: tile.pattern.width(),
        height,
        rows: tile.rows,
        left: known.then(|| core::array::from_fn(|y| side[y * TILE / height % TILE])),
        anchor,
        activity: near.activity[channel as usize],
        base: channel.base(),
    }
}

/// Keeps what the next tiles' planes need to know of this one.
#[inline(always)]
fn end_plane(tile: &Tile, near: &mut Neighbours, channel: Channel, task: &PlaneTask, activity: i16x8) {
    let plane = channel.plane(tile);
    let side: Side = core::array::from_fn(|i| plane.row(i * task.height / TILE)[task.width - 1]);
    if matches!(channel, Channel::Depth) {
        near.last_depth = Some(side[0]);
    }
    near.left.sides[channel as usize] = side;
    near.activity[channel as usize] = activity;
}

/// The first valid pixel's value, where it is known.
fn first_valid<C: Coder>(tile: &Tile, channel: Channel) -> u32 {
    match tile.rows.iter().position(|row| *row != 0) {
        Some(y) if !C::DECODES => channel.plane(tile).row(y)[tile.rows[y].trailing_zeros() as usize] as u32,
        _ => 1,
    }
}

/// What stands in for a tile's surroundings where none are known.
fn code_anchor<C: Coder>(coder: &mut C, value: u32, before: Option<i16>) -> i16 {
    match before {
        None => code_octaves(|bits, value| coder.raw(bits, value), value).min(MAX_DEPTH as u32) as i16,
        Some(before) => {
            let before = i32::from(before);
            let folded = code_number(coder, ANCHOR, fold(value as i32 - before));
            (before + unfold(folded)).clamp(1, MAX_DEPTH) as i16
        }
    }
}
