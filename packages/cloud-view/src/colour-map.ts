/**
 * The colour map for values of points: from violet through blue and green to yellow. Equal steps of the value look
 * equally large, and lightness only rises, so that the map can be read in grey and by colour-blind people. Computed in
 * Björn Ottosson's Oklab, where distances are perceived differences.
 */

/** Red, green and blue in sRGB, 0–1 each. */
export type Rgb = readonly [red: number, green: number, blue: number];

/** Number of colours between which the shader and {@link colourAt} interpolate linearly. */
export const COLOUR_STOPS = 17;

/** Lightness and hue (degrees) at both ends. The darkest colour still stands out from a dark background. */
const FROM = { lightness: 0.4, hue: 300 };
const TO = { lightness: 0.95, hue: 105 };
/** The strongest colour, in Oklab. Chosen by eye: stronger ones hide shapes. */
const MOST_CHROMA = 0.16;
/** Share of the chroma that a screen can show. Chosen: rounding leaves the screen's range no more. */
const CHROMA_SHARE = 0.93;
/** Steps in which the curve is measured. */
const STEPS = 512;

type Lab = readonly [lightness: number, a: number, b: number];

/** A colour's lightness (0–1) and hue (degrees) in Oklab. */
export interface Tint {
  readonly lightness: number;
  readonly hue: number;
}

/** Oklab to linear sRGB, which lies outside 0–1 if a screen cannot show the colour. */
function linearOf([lightness, a, b]: Lab): Rgb {
  const long = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const medium = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const short = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    4.0767416621 * long - 3.3077115913 * medium + 0.2309699292 * short,
    -1.2684380046 * long + 2.6097574011 * medium - 0.3413193965 * short,
    -0.0041960863 * long - 0.7034186147 * medium + 1.707614701 * short,
  ];
}

function encode(linear: number): number {
  const value = Math.min(Math.max(linear, 0), 1);
  return value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055;
}

function labAt(part: number): Lab {
  return labOf({
    lightness: FROM.lightness + (TO.lightness - FROM.lightness) * part,
    hue: FROM.hue + (TO.hue - FROM.hue) * part,
  });
}

/** As strong a colour as a screen can show, up to {@link MOST_CHROMA}. */
function labOf({ lightness, hue: degrees }: Tint): Lab {
  const hue = (degrees * Math.PI) / 180;
  const at = (chroma: number): Lab => [lightness, chroma * Math.cos(hue), chroma * Math.sin(hue)];
  let [least, most] = [0, 0.4];
  for (let i = 0; i < 20; i++) {
    const middle = (least + most) / 2;
    if (linearOf(at(middle)).every((value) => value >= 0 && value <= 1)) least = middle;
    else most = middle;
  }
  return at(Math.min(MOST_CHROMA, least * CHROMA_SHARE));
}

function rgbOf(lab: Lab): Rgb {
  const [red, green, blue] = linearOf(lab);
  return [encode(red), encode(green), encode(blue)];
}

/** A strong colour of this lightness and hue that a screen can show. */
export function rgbOfTint(tint: Tint): Rgb {
  return rgbOf(labOf(tint));
}

let stops: readonly Rgb[] | null = null;

/** The {@link COLOUR_STOPS} colours at equal distances, from the smallest value's to the largest's. */
export function colourStops(): readonly Rgb[] {
  stops ??= computeStops();
  return stops;
}

/** Places the stops at equal distances along the curve. */
function computeStops(): Rgb[] {
  const curve = Array.from({ length: STEPS + 1 }, (_, i) => labAt(i / STEPS));
  const lengths = [0];
  for (let i = 1; i <= STEPS; i++) {
    const [from, to] = [curve[i - 1] as Lab, curve[i] as Lab];
    const step = Math.hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
    lengths.push((lengths[i - 1] as number) + step);
  }
  const whole = lengths[STEPS] as number;
  return Array.from({ length: COLOUR_STOPS }, (_, stop) => {
    const wanted = (whole * stop) / (COLOUR_STOPS - 1);
    const at = lengths.findIndex((length) => length >= wanted - 1e-9);
    return rgbOf(curve[at] as Lab);
  });
}

/**
 * The colour of a value, as the point shader computes it.
 *
 * @param level place of the value in the range: 0 the smallest, 1 the largest; clamped
 */
export function colourAt(level: number): Rgb {
  const all = colourStops();
  const place = Math.min(Math.max(level, 0), 1) * (COLOUR_STOPS - 1);
  const low = Math.min(Math.floor(place), COLOUR_STOPS - 2);
  const [from, to] = [all[low] as Rgb, all[low + 1] as Rgb];
  const mix = (channel: 0 | 1 | 2) => from[channel] + (to[channel] - from[channel]) * (place - low);
  return [mix(0), mix(1), mix(2)];
}
