/** The lines of text on the wrist panel. */
import type { RobotListing, Telemetry } from '@farpoint/operator';
import type { Hand } from '../ground/headset-settings.ts';
import { lossTone, mbps, ms } from './facts.ts';
import { motionWords } from './motion-words.ts';
import type { PageStats } from './page-stats.ts';
import { viewLead } from './view-words.ts';
import { driveStateWords, type Words } from './words.ts';

export interface WristFacts {
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

export function wristLines({
  link,
  driving,
  telemetry,
  speed,
  near,
  estopLatched,
  estopAtRobot,
  stop,
  nextRobot,
  driveHand,
  view,
  hazards,
  alarm,
  figures,
}: WristFacts): Words[] {
  const { pointsPerFrame, framesPerSecond, minRttMs, viewAgeMs, lossRate } = figures;
  const thousands = (pointsPerFrame / 1000).toFixed(1);
  const charge = telemetry?.battery?.percentage;
  const hints = [
    ...[view, hazards].filter((hint) => hint !== null),
    charge === undefined ? `Squeeze ${driveHand}: drive  B: stop` : `Battery ${Math.round(charge * 100)} %`,
    ...(nextRobot === null ? [] : [`press ${driveHand} stick: ${nextRobot.name}`]),
  ];
  return [
    link,
    ...(telemetry === null ? [] : [motionWords(telemetry.motion) ?? driveStateWords(telemetry)]),
    ...[speed, near].filter((words) => words !== null),
    driving,
    // An unconfirmed STOP, an alarm or a confirmed STOP takes the place of the line that matters least.
    (stop?.tone === 'good' ? null : stop) ??
      alarm ??
      stop ?? {
        text: `${thousands}k points  ${framesPerSecond.toFixed(0)}/s  ${mbps(figures)} Mbit/s`,
        tone: 'neutral',
      },
    {
      text: `rtt ${ms(minRttMs)}  view ${ms(viewAgeMs)} old  loss ${(lossRate * 100).toFixed(1)} %${viewLead(figures.view)}`,
      tone: lossTone(figures),
    },
    estopLatched
      ? {
          text: estopAtRobot ? 'Released at the robot only' : 'Release: open hand, hold trigger 1 s',
          tone: 'bad',
        }
      : { text: hints.join('  '), tone: 'neutral' },
  ];
}
