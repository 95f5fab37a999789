//! The order of symbols in a packet and the contexts they are coded with: one walk for coding and decoding.

mod blocks;
mod mask;
mod neighbours;
mod number;
mod plane;
mod rows;
mod tile_coder;
mod wavefront;

pub use neighbours::Neighbours;
pub use tile_coder::TileCoder;

use blocks::{code_blocks, code_points};
use neighbours::{Edge, NO_EDGE};
use number::{code_number, fold, unfold};
use plane::{Channel, PlaneTask, Side};
use wide::i16x8;

use crate::contexts::{ANCHOR, KIND, PATTERN};
use crate::rans::{Coder, Decoder, code_octaves};
use crate::tile::{ColourMode, Kind, LAST_TRANSFORMED, MAX_DEPTH, Pattern, Place, TILE, Tile};

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

/// Codes the mask of a mixed tile; a full one has none.
#[inline(never)]
fn code_mask<C: TileCoder>(coder: &mut C, tile: &mut Tile) {
    let (width, height) = (tile.pattern.width(), tile.pattern.height());
    if tile.kind == Kind::Full {
        tile.rows = [0; TILE];
        tile.rows[..height].fill(((1_u32 << width) - 1) as u16);
        return;
    }
    coder.mask(&mut tile.rows, width, height);
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
