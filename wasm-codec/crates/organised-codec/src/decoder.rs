//! Packets to points.

use bytemuck::must_cast;
use wide::{f32x4, i32x4};

use crate::rans;
use crate::stream::{PACKET_HEADER_BYTES, PacketError, PacketHeader, StreamHeader};
use crate::syntax::{Neighbours, code_tile};
use crate::tables::{COLOUR_SETS, GEOMETRY_SETS, Tables};
use crate::tile::{ColourMode, Grid, Kind, LAST_TRANSFORMED, Place, TILE, Tile};
use crate::transform::{inverse, plane_step, point_step, to_rgba};

/// Pure green, R lowest.
const GREEN: u32 = 0xff00_ff00;

/// What a packet brought.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Put {
    /// Where its points begin among the decoder's.
    pub start: usize,
    /// How many.
    pub points: usize,
    /// True where every point is pure green (a latency test).
    pub latency_test: bool,
}

/// Depth and colour images beside the points.
struct Images {
    /// Metres, 0 where there is no point.
    depth: Vec<f32>,
    /// R lowest.
    colour: Vec<u32>,
}

/// Decodes the packets of one stream, frame by frame.
pub struct Decoder {
    header: StreamHeader,
    grid: Grid,
    tables: Tables,
    /// x at 1 m of each column, padded to whole tiles.
    columns: Vec<f32>,
    /// y at 1 m of each row.
    rows: Vec<f32>,
    /// int16 x, y, z in millimetres and 6-6-4 colour: 8 bytes a point.
    points: Vec<u64>,
    palette: Vec<u32>,
    count: usize,
    /// A bit for each tile that has come.
    come: Vec<u64>,
    images: Option<Images>,
    tile: Tile,
    rgba: [u32; TILE * TILE],
}

impl Decoder {
    /// With `images`, depth and colour images are written too. `None` where a value of the header is outside its range.
    #[must_use]
    pub fn new(header: StreamHeader, images: bool) -> Option<Self> {
        if !header.is_valid() {
            return None;
        }
        let grid = header.grid();
        let pixels = grid.width * grid.height;
        let mut columns: Vec<f32> = header.intrinsics.columns(grid.width).collect();
        columns.resize(grid.columns * TILE, 0.0);
        let palette = header.palette.iter().map(|[r, g, b]| u32::from_le_bytes([*r, *g, *b, 255])).collect();
        let tables = Tables::new(&header.index_frequencies);
        let rows = header.intrinsics.rows(grid.height).collect();
        Some(Self {
            header,
            palette,
            grid,
            tables,
            columns,
            rows,
            points: vec![0; pixels],
            count: 0,
            come: vec![0; grid.tiles().div_ceil(64)],
            images: images.then(|| Images { depth: vec![0.0; pixels], colour: vec![0; pixels] }),
            tile: Tile::new(),
            rgba: [0; TILE * TILE],
        })
    }

    /// The stream's header.
    #[must_use]
    pub fn header(&self) -> &StreamHeader {
        &self.header
    }

    /// Begins a frame: no points, empty images.
    pub fn begin(&mut self) {
        self.count = 0;
        self.come.fill(0);
        if let Some(images) = &mut self.images {
            images.depth.fill(0.0);
            images.colour.fill(0);
        }
    }

    /// The points of the frame so far, in the order of the packets.
    #[must_use]
    pub fn points(&self) -> &[u64] {
        &self.points[..self.count]
    }

    /// The whole buffer behind [`Decoder::points`], for a view.
    #[must_use]
    pub fn point_buffer(&self) -> &[u64] {
        &self.points
    }

    /// Depth in metres, 0 where there is none; empty where the decoder makes no images.
    #[must_use]
    pub fn depth(&self) -> &[f32] {
        self.images.as_ref().map_or(&[], |images| &images.depth)
    }

    /// Colours, R lowest.
    #[must_use]
    pub fn colour(&self) -> &[u32] {
        self.images.as_ref().map_or(&[], |images| &images.colour)
    }

    /// Decodes a packet and adds its points.
    ///
    /// # Errors
    /// See [`PacketError`]; nothing of the packet is kept then, save in the images, where a corrupt packet may have left pixels.
    pub fn put(&mut self, packet: &[u8]) -> Result<Put, PacketError> {
        let header = PacketHeader::parse(packet)?;
        if header.id != self.header.id {
            return Err(PacketError::UnknownStream);
        }
        let first = usize::from(header.first);
        let end = first + usize::from(header.count);
        if header.count == 0 || end > self.grid.tiles() {
            return Err(PacketError::Tiles);
        }
        if (first..end).any(|tile| self.come[tile / 64] >> (tile % 64) & 1 == 1) {
            return Err(PacketError::Duplicate);
        }
        let start = self.count;
        match self.decode(&header, first..end, &packet[PACKET_HEADER_BYTES..]) {
            Some(count) => {
                for tile in first..end {
                    self.come[tile / 64] |= 1 << (tile % 64);
                }
                self.count = count;
                let latency_test = header.mode == ColourMode::None;
                Ok(Put { start, points: count - start, latency_test })
            }
            None => Err(PacketError::Corrupt),
        }
    }

    /// The number of points with those of these tiles; `None` where the data is not what an encoder writes.
    fn decode(
        &mut self,
        header: &PacketHeader,
        tiles: core::ops::Range<usize>,
        data: &[u8],
    ) -> Option<usize> {
        const { assert!(GEOMETRY_SETS == 8 && COLOUR_SETS == 4) };
        let geometry = self.tables.geometry(header.geometry_set.into());
        let colour = self.tables.colour(header.colour_set.into());
        let mut coder = rans::Decoder::new(data, geometry, colour)?;
        let mut near = Neighbours::new();
        let scale = 1.0 / self.header.depth_step(header.depth_level);
        let mut count = self.count;
        for index in tiles {
            let place = self.grid.place(index);
            code_tile(
                &mut coder,
                &mut self.tile,
                &mut near,
                place.row_in_strip,
                place.column == 0,
                header.mode,
            );
            if coder.overrun() {
                return None;
            }
            if self.tile.kind == Kind::Empty {
                continue;
            }
            paint(&self.tile, header, &self.palette, &mut self.rgba)?;
            let view = View { grid: self.grid, columns: &self.columns, rows: &self.rows, place, scale };
            count = emit(&self.tile, &self.rgba, &view, &mut self.points, count, self.images.as_mut())?;
        }
        coder.finished().then_some(count)
    }
}

/// The colours of a tile's pixels, `None` where one is not in the palette; pixel x, y of the pattern at `y * TILE + x`.
fn paint(tile: &Tile, header: &PacketHeader, palette: &[u32], rgba: &mut [u32; TILE * TILE]) -> Option<()> {
    let (width, height) = (tile.pattern.width(), tile.pattern.height());
    let quality = usize::from(header.quality);
    if header.mode == ColourMode::None {
        rgba.fill(GREEN);
        return Some(());
    }
    if header.mode == ColourMode::Palette {
        for y in 0..height {
            for x in 0..width {
                rgba[y * TILE + x] = *palette.get(tile.index[Tile::at(x, y)] as usize - 1)?;
            }
        }
        return Some(());
    }
    if tile.pattern > LAST_TRANSFORMED {
        let step = point_step(quality);
        let mut points = tile.points.iter();
        for y in 0..height {
            for x in 0..width {
                if tile.rows[y] >> x & 1 == 1 {
                    let [y4, co, cg] = points.next().map_or([0; 3], |point| point.map(|c| (c * step) >> 2));
                    rgba[y * TILE + x] = to_rgba(y4, co, cg);
                }
            }
        }
        return Some(());
    }
    let subsampled = header.mode == ColourMode::Subsampled;
    let mut index = 0;
    let mut planes = [[0_i32; TILE * TILE]; 3];
    for (plane, pixels) in planes.iter_mut().enumerate() {
        let (columns, rows) = header.mode.blocks(tile.pattern, plane);
        let luma = header.mode.blocks(tile.pattern, 0);
        let step = plane_step(quality, plane, subsampled);
        for by in 0..rows {
            for bx in 0..columns {
                if (columns, rows) != luma || tile.block_is_seen(bx, by) {
                    let block = inverse(&tile.blocks[index], step);
                    for (y, row) in block.iter().enumerate() {
                        let at = (by * 8 + y) * TILE + bx * 8;
                        pixels[at..at + 8].copy_from_slice(&row.to_array());
                    }
                }
                index += 1;
            }
        }
    }
    let [luma, orange, green] = &planes;
    if subsampled && tile.pattern.0 < 2 {
        let across = usize::from(tile.pattern.0 == 0);
        for y in 0..height {
            let row = y / 2 * TILE;
            let (orange, green): (&[i32; 8], &[i32; 8]) = (
                orange[row..row + 8].first_chunk().expect("eight pixels"),
                green[row..row + 8].first_chunk().expect("eight pixels"),
            );
            // Whole rows of 16, so that the compiler makes vectors of them.
            let co: [i32; TILE] = core::array::from_fn(|x| orange[x >> across & 7]);
            let cg: [i32; TILE] = core::array::from_fn(|x| green[x >> across & 7]);
            let luma: &[i32; TILE] = luma[y * TILE..][..TILE].first_chunk().expect("a row");
            let pixels: &mut [u32; TILE] = rgba[y * TILE..][..TILE].first_chunk_mut().expect("a row");
            for x in 0..TILE {
                pixels[x] = to_rgba(luma[x], co[x], cg[x]);
            }
        }
    } else {
        for (((pixel, y), co), cg) in rgba.iter_mut().zip(luma).zip(orange).zip(green) {
            *pixel = to_rgba(*y, *co, *cg);
        }
    }
    Some(())
}

struct View<'a> {
    grid: Grid,
    columns: &'a [f32],
    rows: &'a [f32],
    place: Place,
    /// 1 / step of inverse depth.
    scale: f32,
}

/// Millimetres, rounded half away from zero; never beyond ±32767.
#[inline(always)]
fn round4(mm: f32x4) -> i32x4 {
    const LIMIT: f32x4 = f32x4::splat(32_767.0);
    let sign: i32x4 = must_cast::<f32x4, i32x4>(mm) & i32x4::splat(i32::MIN);
    let half: f32x4 = must_cast(sign | i32x4::splat(0x3f00_0000));
    let limited = (mm + half).fast_min(LIMIT).fast_max(-LIMIT);
    limited.fast_trunc_int()
}

#[inline(always)]
fn colour_664(rgba: i32x4) -> i32x4 {
    let red = (rgba & i32x4::splat(0xfc)) << 24;
    let green = (rgba & i32x4::splat(0xfc00)) << 10;
    let blue = (rgba >> 4) & i32x4::splat(0xf_0000);
    red | green | blue
}

/// Writes a tile's points from `count` on; `None` where a pixel outside the image is said to be valid, or there are more
/// points than pixels.
fn emit(
    tile: &Tile,
    rgba: &[u32; TILE * TILE],
    view: &View<'_>,
    points: &mut [u64],
    mut count: usize,
    mut images: Option<&mut Images>,
) -> Option<usize> {
    let View { grid, columns, rows, place, scale } = *view;
    let (width, height) = (tile.pattern.width(), tile.pattern.height());
    let shift = tile.pattern.0 >> 1;
    let odd = usize::from(tile.pattern.0 & 1);
    let (x0, y0) = (place.column * TILE, place.row * TILE);
    for y in 0..height {
        let valid = tile.rows[y];
        if valid == 0 {
            continue;
        }
        let v = y0 + (y << shift);
        let first = x0 + ((odd & y) << shift);
        let step = 1 << (usize::from(shift) + odd);
        let last = first + (15 - valid.leading_zeros() as usize) * step;
        if v >= grid.height || last >= grid.width {
            return None;
        }
        let ray_y = f32x4::splat(rows[v]);
        let mut packed = [0_u64; TILE];
        for x in (0..width).step_by(4) {
            let depth: [i32; 4] = *tile.depth[Tile::at(x, y)..].first_chunk().expect("four pixels");
            let ray_x = if step == 1 {
                f32x4::from(*columns[first + x..].first_chunk::<4>().expect("four columns"))
            } else {
                let ray = |i: usize| columns[(first + (x + i) * step).min(columns.len() - 1)];
                f32x4::from([ray(0), ray(1), ray(2), ray(3)])
            };
            let z = f32x4::splat(scale) / f32x4::from_i32x4(i32x4::from(depth));
            let thousand = f32x4::splat(1000.0);
            let px = round4(z * ray_x * thousand);
            let py = round4(z * ray_y * thousand);
            let pz = round4(z * thousand);
            let colours: [u32; 4] = *rgba[y * TILE + x..].first_chunk().expect("four colours");
            let low: i32x4 = (px & i32x4::splat(0xffff)) | (py << 16);
            let high: i32x4 = (pz & i32x4::splat(0xffff)) | colour_664(must_cast(colours));
            let (low, high) = (low.to_array(), high.to_array());
            for i in 0..4 {
                packed[x + i] = u64::from(low[i] as u32) | u64::from(high[i] as u32) << 32;
            }
            if let Some(images) = images.as_deref_mut() {
                let depths = z.to_array();
                for i in 0..4 {
                    if valid >> (x + i) & 1 == 1 {
                        let pixel = v * grid.width + first + (x + i) * step;
                        images.depth[pixel] = depths[i];
                        images.colour[pixel] = colours[i];
                    }
                }
            }
        }
        let target = &mut points[count..];
        if valid == u16::MAX {
            *target.first_chunk_mut::<TILE>()? = packed;
            count += TILE;
        } else {
            let mut rest = valid;
            let needed = valid.count_ones() as usize;
            for place in target.get_mut(..needed)? {
                *place = packed[rest.trailing_zeros() as usize & 15];
                rest &= rest - 1;
            }
            count += needed;
        }
    }
    Some(count)
}
