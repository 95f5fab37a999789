/** The contents of the table of figures over the picture. */

import type { PictureUse } from '@farpoint/cloud-view';
import type { Battery, EstopState, Telemetry } from '@farpoint/operator';
import { BitRate } from '@farpoint/timing';
import type { VideoColourFigures } from '../take/video/video-colour.ts';
import { texts } from './language.ts';
import { motionWords, speedLimitWords } from './motion-words.ts';
import { fixed, grouped, percent } from './numbers.ts';
import type { PageStats } from './page-stats.ts';
import type { ShownReading } from './shown-readings.ts';
import { viewWords } from './view-words.ts';
import { driveStateWords, type Tone } from './words.ts';

/**
 * Says whether the surface has the colours of its camera's video, and if not, why.
 *
 * @returns `null` if the robot sends no video of its depth camera
 */
export function videoColourWords({ state, share, use }: VideoColourFigures): string | null {
  const said = texts().figures.colours;
  switch (state) {
    case 'not-offered':
    case 'no-surface':
    case 'other-colours':
      return null;
    case 'painted':
      return share > 0.95 ? said.painted : said.partly(percent(share));
    case 'no-match':
      return said.noMatch(misfitWords(use));
    default:
      return said[state];
  }
}

/** Why a picture paints nothing. */
function misfitWords(use: PictureUse | null): string {
  const said = texts().figures.misfits;
  switch (use) {
    case 'other-shape':
    case 'too-large':
    case 'unreadable':
      return said[use];
    default:
      return said.other;
  }
}

export interface Fact {
  name: string;
  value: string;
  tone?: Tone;
}

/** What stands in place of a figure that is not live. */
export const NO_FIGURE = '–';
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
  const { names } = texts().figures;
  // What stays true without a word from the robot, and what is measured of arriving points.
  const ofThePage = [names.robot, names.remembered, names.motionToPhoton];
  const ofPoints = [names.points, names.drawn, names.colours, names.rate, names.loss, names.viewAge];
  const isLive = (name: string) =>
    ofThePage.includes(name) || (heard && (pointsHeard || !ofPoints.includes(name)));
  return allFacts(session).map((fact) => (isLive(fact.name) ? fact : { name: fact.name, value: NO_FIGURE }));
}

function allFacts({ drives, name, telemetry, estop, maxLinear, readings, figures }: SessionFacts): Fact[] {
  const { names } = texts().figures;
  const facts: Fact[] = [];
  if (name !== null) facts.push({ name: names.robot, value: name });
  if (telemetry !== null) facts.push(...telemetryFacts(telemetry, estop, maxLinear));
  if (telemetry !== null && figures.view !== undefined && drives)
    facts.push({ name: names.view, value: viewWords(figures.view) });
  addReadings(facts, readings);
  facts.push(...streamFacts(figures));
  if (telemetry !== null && telemetry.operators > 1) {
    facts.push({ name: names.operators, value: String(telemetry.operators) });
  }
  return facts;
}

function telemetryFacts(telemetry: Telemetry, estop: EstopState, maxLinear: number): Fact[] {
  const { names } = texts().figures;
  // Telemetry reports an emergency stop a moment later than the `estop` message.
  const bounded = estop.latched ? null : motionWords(telemetry.motion);
  const drive = bounded ?? driveStateWords(estop.latched ? { drive: 'estop' } : telemetry);
  const { linear, angular } = telemetry.twist;
  const facts: Fact[] = [
    { name: names.state, value: stoppedWords(drive.text, estop), tone: drive.tone },
    { name: names.speed, value: velocityWords(linear.x, linear.y, angular.z) },
  ];
  const limit = speedLimitWords(telemetry, maxLinear);
  if (limit !== null) facts.push({ name: names.speedLimit, value: limit.text, tone: limit.tone });
  if (telemetry.battery !== undefined) facts.push(batteryFact(telemetry.battery));
  return facts;
}

/** A speed to the side is a speed if it is shown as more than 0.00. */
const LEAST_SHOWN_MPS = 0.005;

function velocityWords(forward: number, aside: number, turn: number): string {
  const sideways =
    Math.abs(aside) < LEAST_SHOWN_MPS ? [] : [texts().figures.sideways(fixed(Math.abs(aside), 2), aside > 0)];
  return [`${fixed(forward, 2)} m/s`, ...sideways, `${fixed(turn, 2)} rad/s`].join('  ');
}

/** With who has stopped it, and where that is released. */
function stoppedWords(state: string, { latched, by, releasedAt }: EstopState): string {
  if (!latched || by === undefined) return state;
  const said = texts().figures;
  const stopped = releasedAt === 'robot' ? said.stoppedAtRobot : said.stoppedBy;
  return stopped(state, said.stoppers[by]);
}

/** What is unknown is not 0. */
function batteryFact({ percentage: share, voltage }: Battery): Fact {
  const said = texts().figures;
  const known = [
    share === undefined ? said.chargeUnknown : percent(share),
    ...(voltage === undefined ? [] : [`${fixed(voltage, 1)} V`]),
  ];
  const tone = share === undefined || share >= 0.25 ? 'neutral' : share < 0.1 ? 'bad' : 'warning';
  return { name: said.names.battery, value: known.join('  '), tone };
}

/** The label of the robot's reading of its battery. */
const ROBOTS_BATTERY = 'Battery';

/**
 * A battery reading replaces the telemetry's two figures, because it says more. Any other reading whose name is taken
 * gets a row of its own, with its topic in the name.
 */
function addReadings(facts: Fact[], readings: readonly ShownReading[]): void {
  const { battery } = texts().figures.names;
  for (const { topic, label, text, tone } of readings) {
    // The robot names its battery in English.
    const shown = label === ROBOTS_BATTERY ? battery : label;
    const there = facts.find(({ name }) => name === shown);
    if (there !== undefined && shown === battery) Object.assign(there, { value: text, tone });
    else facts.push({ name: there === undefined ? shown : `${shown} (${topic})`, value: text, tone });
  }
}

function streamFacts(figures: PageStats): Fact[] {
  const { names, p95: withP95 } = texts().figures;
  const facts: Fact[] = [
    {
      name: names.points,
      value: `${grouped(figures.pointsPerFrame)} × ${figures.framesPerSecond.toFixed(0)}/s`,
    },
    ...thinningFacts(figures),
    ...memoryFacts(figures),
    ...paintFacts(figures),
    { name: names.rate, value: `${mbps(figures)} Mbit/s` },
    { name: names.loss, value: `${fixed(figures.lossRate * 100, 1)} %`, tone: lossTone(figures) },
    { name: names.roundTrip, value: ms(figures.minRttMs) },
    { name: names.viewAge, value: ms(figures.viewAgeMs) },
  ];
  if (figures.mtpMs !== null) {
    const { p50, p95 } = figures.mtpMs;
    facts.push({ name: names.motionToPhoton, value: withP95(ms(p50), ms(p95)) });
  }
  return facts;
}

/** What is left out because this computer is too slow. */
function thinningFacts({ pointsPerFrame, drawnOneOf }: PageStats): Fact[] {
  if (drawnOneOf === 1) return [];
  const { names, drawnOf } = texts().figures;
  const value = drawnOf(roughly(pointsPerFrame / drawnOneOf), roughly(pointsPerFrame));
  return [{ name: names.drawn, value, tone: 'warning' }];
}

/** How old what is drawn beside the live clouds may be. */
function memoryFacts({ remembered }: PageStats): Fact[] {
  if (remembered === null) return [];
  return [{ name: texts().figures.names.remembered, value: rememberedAge(remembered.oldestS) }];
}

/** Where the surface's colours come from, from a robot that sends the video of its depth camera. */
function paintFacts({ videoColour }: PageStats): Fact[] {
  const words = videoColour === undefined ? null : videoColourWords(videoColour);
  return words === null ? [] : [{ name: texts().figures.names.colours, value: words }];
}

/** @param oldestS age of the oldest, seconds */
export function rememberedAge(oldestS: number): string {
  const { upToOld, aDayOld } = texts().measures;
  if (oldestS < 60) return upToOld(`${Math.max(Math.ceil(oldestS / 10) * 10, 10)} s`);
  if (oldestS < 5400) return upToOld(`${Math.ceil(oldestS / 60)} min`);
  return oldestS < 24 * 3600 ? upToOld(`${Math.ceil(oldestS / 3600)} h`) : aDayOld;
}

/** To hundreds; fewer than a thousand to tens, so that a few never read as none. */
function roughly(points: number): string {
  const unit = points < 1000 ? 10 : 100;
  return grouped(Math.round(points / unit) * unit);
}

export function lossTone({ lossRate }: PageStats): Tone {
  return lossRate > 0.05 ? 'warning' : 'neutral';
}

export function mbps({ bitsPerSecond }: PageStats): string {
  return fixed(BitRate.toMbps(bitsPerSecond), 1);
}

export function ms(value: number | null | undefined): string {
  return value === null || value === undefined ? NO_FIGURE : `${value.toFixed(0)} ms`;
}
