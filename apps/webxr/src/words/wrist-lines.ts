/** The lines of text on the wrist panel. */
import type { RobotListing, Telemetry } from '@farpoint/operator';
import type { Hand } from '../ground/headset-settings.ts';
import { lossTone, mbps, ms, NO_FIGURE } from './facts.ts';
import { motionWords } from './motion-words.ts';
import type { PageStats } from './page-stats.ts';
import { viewLead } from './view-words.ts';
import { driveStateWords, type Words } from './words.ts';

export interface WristFacts {
  /** Whether there is a session: otherwise there is nothing to say of a robot. */
  live: boolean;
  /** Something has come from the robot just now, and points have: otherwise no figure is live. */
  heard: boolean;
  pointsHeard: boolean;
  link: Words;
  driving: Words;
  telemetry: Telemetry | null;
  /** How fast the robot is and may be; `null` before it has said so. */
  speed: Words | null;
  /** What is near the robot; `null` if it does not tell. */
  near: Words | null;
  estopLatched: boolean;
  /** It can be released at the robot only. */
  estopAtRobot: boolean;
  /** What has become of STOP; `null` if there is nothing to say. */
  stop: Words | null;
  /** What the robot demands when commands come again after a gap that stopped it. */
  nextRobot: RobotListing | null;
  /** Why there is no robot to choose; `null` if there is one, or one has been chosen. */
  noRobots: Words | null;
  /** The hand that drives. */
  driveHand: Hand;
  /** The view, unless it is the usual one. */
  view: string | null;
  /** What tints mean; `null` without tints. */
  hazards: string | null;
  /** The worst alarm and how many others there are; `null` if none is raised. */
  alarm: Words | null;
  figures: PageStats;
}

export function wristLines(facts: WristFacts): Words[] {
  const { live, heard, link, noRobots, driving, telemetry, speed, near, stop, alarm } = facts;
  if (!live) return [link, ...(noRobots === null ? [] : [firstSentence(noRobots)]), lastLine(facts)];
  const isKnown = heard && telemetry !== null;
  return [
    link,
    ...(isKnown ? [motionWords(telemetry.motion) ?? driveStateWords(telemetry)] : []),
    ...[speed, near].filter((words) => words !== null),
    driving,
    // An unconfirmed STOP, an alarm or a confirmed STOP takes the place of the line that matters least.
    (stop?.tone === 'good' ? null : stop) ?? alarm ?? stop ?? streamLine(facts),
    linkLine(facts),
    lastLine(facts),
  ];
}

/** The sign before the eyes says the rest. */
function firstSentence({ text, tone }: Words): Words {
  const end = text.indexOf('. ');
  return { text: end < 0 ? text : text.slice(0, end + 1), tone };
}

function streamLine({ heard, pointsHeard, figures }: WristFacts): Words {
  if (!heard || !pointsHeard) return { text: `points ${NO_FIGURE}`, tone: 'neutral' };
  const { pointsPerFrame, framesPerSecond } = figures;
  const points = `${(pointsPerFrame / 1000).toFixed(1)}k points`;
  return { text: `${points}  ${framesPerSecond.toFixed(0)}/s  ${mbps(figures)} Mbit/s`, tone: 'neutral' };
}

function linkLine({ heard, pointsHeard, figures }: WristFacts): Words {
  const { minRttMs, viewAgeMs, lossRate, view } = figures;
  const trip = heard ? ms(minRttMs) : NO_FIGURE;
  if (!heard || !pointsHeard)
    return { text: `rtt ${trip}  view ${NO_FIGURE}  loss ${NO_FIGURE}`, tone: 'neutral' };
  const loss = `${(lossRate * 100).toFixed(1)} %${viewLead(view)}`;
  return { text: `rtt ${trip}  view ${ms(viewAgeMs)} old  loss ${loss}`, tone: lossTone(figures) };
}

/** How the emergency stop is released, or else what hands can do. */
function lastLine({
  live,
  heard,
  telemetry,
  estopLatched,
  estopAtRobot,
  nextRobot,
  driveHand,
  view,
  hazards,
}: WristFacts): Words {
  if (live && estopLatched) {
    if (!heard) return { text: 'STOP, as last heard', tone: 'bad' };
    const text = estopAtRobot ? 'Released at the robot only' : 'Release: open hand, hold trigger 1 s';
    return { text, tone: 'bad' };
  }
  const hints = [
    ...[view, hazards].filter((hint) => hint !== null),
    ...driveHint(live && heard ? telemetry : null, driveHand),
    ...(nextRobot === null ? [] : [`press ${driveHand} stick: ${nextRobot.name}`]),
  ];
  return { text: hints.join('  '), tone: 'neutral' };
}

/** The charge, or else what the hands do; nothing without a robot. */
function driveHint(telemetry: Telemetry | null, driveHand: Hand): string[] {
  if (telemetry === null) return [];
  const charge = telemetry.battery?.percentage;
  return [
    charge === undefined ? `Squeeze ${driveHand}: drive  B: stop` : `Battery ${Math.round(charge * 100)} %`,
  ];
}
