/** The lines of text on the wrist panel. */
import type { AfterGap, RobotListing, Telemetry } from '@farpoint/operator';
import type { Hand } from '../headset/headset-settings.ts';
import { lossTone, mbps, ms, NO_FIGURE } from './facts.ts';
import { motionWords } from './motion-words.ts';
import type { PageStats } from './page-stats.ts';
import { viewLead } from './view-words.ts';
import { driveStateWords, type Words } from './words.ts';

export interface WristFacts {
  /** Something has come from the robot just now: otherwise no figure is live. */
  heard: boolean;
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
  afterGap: AfterGap;
  nextRobot: RobotListing | null;
  /** The hand that drives. */
  driveHand: Hand;
  /** The view, unless it is the usual one. */
  view: string | null;
  /** What tints mean; `null` without tints. */
  hazards: string | null;
  /** The worst alarm and how many others there are; `null` if none is raised. */
  alarm: Words | null;
  figures: PageStats;
  /** Whether figures are wanted; without them, what asks for attention stays. */
  readings: boolean;
}

export function wristLines(facts: WristFacts): Words[] {
  const {
    heard,
    link,
    driving,
    telemetry,
    speed,
    near,
    estopLatched,
    estopAtRobot,
    stop,
    afterGap,
    nextRobot,
    driveHand,
    view,
    hazards,
    alarm,
    readings,
  } = facts;
  const urgent = (stop?.tone === 'good' ? null : stop) ?? alarm ?? stop;
  const hints = [
    ...[view, hazards].filter((hint) => hint !== null),
    // How to drive and how to stop: no reading takes their place.
    `Squeeze ${driveHand}: drive  B: stop`,
    ...(nextRobot === null ? [] : [`press ${driveHand} stick: ${nextRobot.name}`]),
  ];
  return [
    link,
    ...(telemetry === null || !heard
      ? []
      : [motionWords(telemetry.motion) ?? driveStateWords(telemetry.drive, afterGap)]),
    ...[speed, near].filter((words) => words !== null),
    driving,
    // An unconfirmed STOP, an alarm or a confirmed STOP takes the place of the line that matters least.
    ...[urgent ?? (readings ? streamLine(facts) : null), readings ? linkLine(facts) : null].filter(
      (words) => words !== null,
    ),
    estopLatched
      ? {
          text: estopAtRobot ? 'Released at the robot only' : 'Release: open hand, hold trigger 1 s',
          tone: 'bad',
        }
      : { text: hints.join('  '), tone: 'neutral' },
  ];
}

/** What comes of the battery, the points and the link's rate. */
function streamLine({ heard, telemetry, figures }: WristFacts): Words {
  if (!heard) return { text: `points ${NO_FIGURE}`, tone: 'neutral' };
  const { pointsPerFrame, framesPerSecond } = figures;
  const battery = telemetry?.battery;
  const charge = battery === undefined ? '' : `Battery ${Math.round(battery.percentage * 100)} %  `;
  const points = `${(pointsPerFrame / 1000).toFixed(1)}k points  ${framesPerSecond.toFixed(0)}/s`;
  return { text: `${charge}${points}  ${mbps(figures)} Mbit/s`, tone: 'neutral' };
}

function linkLine({ heard, figures }: WristFacts): Words {
  if (!heard) return { text: `rtt ${NO_FIGURE}  frame ${NO_FIGURE}  loss ${NO_FIGURE}`, tone: 'neutral' };
  const { minRttMs, frameLatencyMs, lossRate, view } = figures;
  const loss = `${(lossRate * 100).toFixed(1)} %${viewLead(view)}`;
  return {
    text: `rtt ${ms(minRttMs)}  frame ${ms(frameLatencyMs?.p50)}  loss ${loss}`,
    tone: lossTone(figures),
  };
}
