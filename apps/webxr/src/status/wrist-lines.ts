/** The lines of text on the wrist panel. */
import type { RobotListing, Telemetry } from '@farpoint/operator';
import { lossTone, mbps, ms } from './facts.ts';
import type { PageStats } from './page-stats.ts';
import { driveWords, type Words } from './words.ts';

export interface WristFacts {
  link: Words;
  driving: Words;
  telemetry: Telemetry | null;
  estopLatched: boolean;
  nextRobot: RobotListing | null;
  /** The worst alarm and how many others there are; `null` if none is raised. */
  alarm: Words | null;
  figures: PageStats;
}

export function wristLines({
  link,
  driving,
  telemetry,
  estopLatched,
  nextRobot,
  alarm,
  figures,
}: WristFacts): Words[] {
  const { pointsPerFrame, framesPerSecond, minRttMs, frameLatencyMs, lossRate } = figures;
  const thousands = (pointsPerFrame / 1000).toFixed(1);
  const battery = telemetry?.battery;
  const hints = [
    battery === undefined ? 'Squeeze: drive  B: stop' : `Battery ${Math.round(battery.percentage * 100)} %`,
    ...(nextRobot === null ? [] : [`press stick: ${nextRobot.name}`]),
  ];
  return [
    link,
    ...(telemetry === null ? [] : [driveWords[telemetry.drive]]),
    driving,
    // An alarm takes the place of the line that matters least.
    alarm ?? {
      text: `${thousands}k points  ${framesPerSecond.toFixed(0)}/s  ${mbps(figures)} Mbit/s`,
      tone: 'neutral',
    },
    {
      text: `rtt ${ms(minRttMs)}  frame ${ms(frameLatencyMs?.p50)}  loss ${(lossRate * 100).toFixed(1)} %`,
      tone: lossTone(figures),
    },
    estopLatched
      ? { text: 'Release: open hand, hold trigger 1 s', tone: 'bad' }
      : { text: hints.join('  '), tone: 'neutral' },
  ];
}
