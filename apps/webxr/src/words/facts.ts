/** The contents of the table of figures over the picture. */

import type { PictureUse } from '@farpoint/cloud-view';
import type { Battery, EstopState, Telemetry } from '@farpoint/operator';
import { BitRate } from '@farpoint/timing';
import type { VideoColourFigures } from '../take/video/video-colour.ts';
import { motionWords, speedLimitWords } from './motion-words.ts';
import type { PageStats } from './page-stats.ts';
import type { ShownReading } from './shown-readings.ts';
import { viewWords } from './view-words.ts';
import { driveStateWords, type Tone } from './words.ts';

const OWN_COLOURS = 'the points’ own';

/**
 * Says whether the surface has the colours of its camera's video, and if not, why.
 *
 * @returns `null` if the robot sends no video of its depth camera
 */
export function videoColourWords({ state, share, use }: VideoColourFigures): string | null {
  switch (state) {
    case 'not-offered':
    case 'no-surface':
    case 'other-colours':
      return null;
    case 'painted':
      return share > 0.95 ? 'from the video' : `from the video for ${Math.round(share * 100)} %`;
    case 'switched-off':
      return OWN_COLOURS;
    case 'not-in-step':
      return `${OWN_COLOURS}: video and points are not in step`;
    case 'not-watched':
      return `${OWN_COLOURS}: the video is off`;
    case 'no-picture':
      return `${OWN_COLOURS}: no video comes`;
    case 'late':
      return `${OWN_COLOURS}: the video comes too late`;
    case 'no-match':
      return `${OWN_COLOURS}: ${misfitWords(use)}`;
  }
}

/** Why a picture paints nothing. */
function misfitWords(use: PictureUse | null): string {
  switch (use) {
    case 'other-shape':
      return 'the video’s shape is another';
    case 'too-large':
      return 'the video is too large';
    case 'unreadable':
      return 'this browser cannot paint with the video';
    default:
      return 'no picture was captured with them';
  }
}

/** Whole numbers, as in 12,000. Making a format for each number takes longer than everything else here. */
const inThousands = new Intl.NumberFormat('en', { maximumFractionDigits: 0 });

export interface Fact {
  name: string;
  value: string;
  tone?: Tone;
}

/** What stands in place of a figure that is not live. */
export const NO_FIGURE = '–';
/** What stays true without a word from the robot. */
const OF_THE_PAGE: readonly string[] = ['Robot', 'Remembered', 'Motion to photon'];
/** What is measured of arriving points. */
const OF_POINTS: readonly string[] = ['Points', 'Drawn', 'Colours', 'Rate', 'Loss', 'View age'];

export interface SessionFacts {
  /** Something has come from the robot just now: otherwise no figure is live. */
  heard: boolean;
  /** Points have come just now, as often as they should: otherwise no figure of them is live. */
  pointsHeard: boolean;
  /** Whether it has anything that velocities move: otherwise nothing is predicted. */
  drives: boolean;
  /** The robot's name; `null` before its welcome. */
  name: string | null;
  telemetry: Telemetry | null;
  estop: EstopState;
  /** The most that the robot drives, m/s. */
  maxLinear: number;
  readings: readonly ShownReading[];
  figures: PageStats;
}

export function sessionFacts(session: SessionFacts): Fact[] {
  const { heard, pointsHeard } = session;
  const isLive = (name: string) =>
    OF_THE_PAGE.includes(name) || (heard && (pointsHeard || !OF_POINTS.includes(name)));
  return allFacts(session).map((fact) => (isLive(fact.name) ? fact : { name: fact.name, value: NO_FIGURE }));
}

function allFacts({ drives, name, telemetry, estop, maxLinear, readings, figures }: SessionFacts): Fact[] {
  const facts: Fact[] = [];
  if (name !== null) facts.push({ name: 'Robot', value: name });
  if (telemetry !== null) facts.push(...telemetryFacts(telemetry, estop, maxLinear));
  if (telemetry !== null && figures.view !== undefined && drives)
    facts.push({ name: 'View', value: viewWords(figures.view) });
  addReadings(facts, readings);
  facts.push(...streamFacts(figures));
  if (telemetry !== null && telemetry.operators > 1) {
    facts.push({ name: 'Operators', value: String(telemetry.operators) });
  }
  return facts;
}

function telemetryFacts(telemetry: Telemetry, estop: EstopState, maxLinear: number): Fact[] {
  // Telemetry reports an emergency stop a moment later than the `estop` message.
  const bounded = estop.latched ? null : motionWords(telemetry.motion);
  const drive = bounded ?? driveStateWords(estop.latched ? { drive: 'estop' } : telemetry);
  const where = estop.releasedAt === 'robot' ? '; released at the robot only' : '';
  const by = estop.latched && estop.by !== undefined ? ` (by ${estop.by}${where})` : '';
  const { linear, angular } = telemetry.twist;
  const facts: Fact[] = [
    { name: 'State', value: drive.text + by, tone: drive.tone },
    { name: 'Speed', value: `${linear.x.toFixed(2)} m/s  ${angular.z.toFixed(2)} rad/s` },
  ];
  const limit = speedLimitWords(telemetry, maxLinear);
  if (limit !== null) facts.push({ name: 'Speed limit', value: limit.text, tone: limit.tone });
  if (telemetry.battery !== undefined) facts.push(batteryFact(telemetry.battery));
  return facts;
}

/** What is unknown is not 0. */
function batteryFact({ percentage: share, voltage }: Battery): Fact {
  const known = [
    share === undefined ? 'charge unknown' : `${Math.round(share * 100)} %`,
    ...(voltage === undefined ? [] : [`${voltage.toFixed(1)} V`]),
  ];
  const tone = share === undefined || share >= 0.25 ? 'neutral' : share < 0.1 ? 'bad' : 'warning';
  return { name: 'Battery', value: known.join('  '), tone };
}

/**
 * A battery reading replaces the telemetry's two figures, because it says more. Any other reading whose name is taken
 * gets a row of its own, with its topic in the name.
 */
function addReadings(facts: Fact[], readings: readonly ShownReading[]): void {
  for (const { topic, label, text, tone } of readings) {
    const there = facts.find(({ name }) => name === label);
    if (there !== undefined && label === 'Battery') Object.assign(there, { value: text, tone });
    else facts.push({ name: there === undefined ? label : `${label} (${topic})`, value: text, tone });
  }
}

function streamFacts(figures: PageStats): Fact[] {
  const facts: Fact[] = [
    {
      name: 'Points',
      value: `${inThousands.format(figures.pointsPerFrame)} × ${figures.framesPerSecond.toFixed(0)}/s`,
    },
    ...thinningFacts(figures),
    ...memoryFacts(figures),
    ...paintFacts(figures),
    { name: 'Rate', value: `${mbps(figures)} Mbit/s` },
    { name: 'Loss', value: `${(figures.lossRate * 100).toFixed(1)} %`, tone: lossTone(figures) },
    { name: 'Round trip', value: ms(figures.minRttMs) },
    { name: 'View age', value: ms(figures.viewAgeMs) },
  ];
  if (figures.mtpMs !== null) {
    const { p50, p95 } = figures.mtpMs;
    facts.push({ name: 'Motion to photon', value: `${ms(p50)}  p95 ${ms(p95)}` });
  }
  return facts;
}

/** What is left out because this computer is too slow. */
function thinningFacts({ pointsPerFrame, drawnOneOf }: PageStats): Fact[] {
  if (drawnOneOf === 1) return [];
  const [drawn, came] = [pointsPerFrame / drawnOneOf, pointsPerFrame].map(roughly);
  return [{ name: 'Drawn', value: `${drawn} of ${came}: this computer is slow`, tone: 'warning' }];
}

/** How old what is drawn beside the live clouds may be. */
function memoryFacts({ remembered }: PageStats): Fact[] {
  if (remembered === null) return [];
  return [{ name: 'Remembered', value: rememberedAge(remembered.oldestS) }];
}

/** Where the surface's colours come from, from a robot that sends the video of its depth camera. */
function paintFacts({ videoColour }: PageStats): Fact[] {
  const words = videoColour === undefined ? null : videoColourWords(videoColour);
  return words === null ? [] : [{ name: 'Colours', value: words }];
}

/** @param oldestS age of the oldest, seconds */
export function rememberedAge(oldestS: number): string {
  if (oldestS < 60) return `up to ${Math.max(Math.ceil(oldestS / 10) * 10, 10)} s old`;
  if (oldestS < 5400) return `up to ${Math.ceil(oldestS / 60)} min old`;
  return oldestS < 24 * 3600 ? `up to ${Math.ceil(oldestS / 3600)} h old` : 'a day old or more';
}

/** To hundreds; fewer than a thousand to tens, so that a few never read as none. */
function roughly(points: number): string {
  const unit = points < 1000 ? 10 : 100;
  return inThousands.format(Math.round(points / unit) * unit);
}

export function lossTone({ lossRate }: PageStats): Tone {
  return lossRate > 0.05 ? 'warning' : 'neutral';
}

export function mbps({ bitsPerSecond }: PageStats): string {
  return BitRate.toMbps(bitsPerSecond).toFixed(1);
}

export function ms(value: number | null | undefined): string {
  return value === null || value === undefined ? NO_FIGURE : `${value.toFixed(0)} ms`;
}
