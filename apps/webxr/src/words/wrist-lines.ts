/** The lines of text on the wrist panel. */
import type { RobotListing, Telemetry } from '@farpoint/operator';
import type { Hand } from '../ground/headset-settings.ts';
import { lossTone, mbps, ms, NO_FIGURE } from './facts.ts';
import { texts } from './language.ts';
import { motionWords } from './motion-words.ts';
import { fixed, percent } from './numbers.ts';
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
  const said = texts().headset;
  if (!heard || !pointsHeard) return { text: said.noPoints(NO_FIGURE), tone: 'neutral' };
  const { pointsPerFrame, framesPerSecond } = figures;
  const points = fixed(pointsPerFrame / 1000, 1);
  return { text: said.stream(points, framesPerSecond.toFixed(0), mbps(figures)), tone: 'neutral' };
}

function linkLine({ heard, pointsHeard, figures }: WristFacts): Words {
  const { minRttMs, viewAgeMs, lossRate, view } = figures;
  const said = texts().headset;
  const trip = heard ? ms(minRttMs) : NO_FIGURE;
  if (!heard || !pointsHeard) return { text: said.trip(trip, NO_FIGURE), tone: 'neutral' };
  const loss = `${fixed(lossRate * 100, 1)} %${viewLead(view)}`;
  return { text: said.tripAndLoss(trip, ms(viewAgeMs), loss), tone: lossTone(figures) };
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
  const said = texts().headset;
  if (live && estopLatched) {
    if (!heard) return { text: said.stopUnheard, tone: 'bad' };
    return { text: estopAtRobot ? said.releasedAtRobot : said.releaseHint, tone: 'bad' };
  }
  const hints = [
    ...[view, hazards].filter((hint) => hint !== null),
    ...driveHint(live && heard ? telemetry : null, driveHand),
    ...(nextRobot === null ? [] : [said.pressFor(said.hands[driveHand], nextRobot.name)]),
  ];
  return { text: hints.join('  '), tone: 'neutral' };
}

/** The charge, or else what the hands do; nothing without a robot. */
function driveHint(telemetry: Telemetry | null, driveHand: Hand): string[] {
  if (telemetry === null) return [];
  const charge = telemetry.battery?.percentage;
  const said = texts().headset;
  return [charge === undefined ? said.driveHint(said.hands[driveHand]) : said.battery(percent(charge))];
}
