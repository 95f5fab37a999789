/** What a saved picture of the view says: when it was taken, of which robot, and whether it was live. Pure. */
import { texts } from './language.ts';

export interface CaptionFacts {
  /** ms since the epoch. */
  readonly epochMs: number;
  /** The robot's name or id; `null` if none is chosen. */
  readonly robot: string | null;
  /** Whether the robot is heard: otherwise nothing that is seen is live. */
  readonly heard: boolean;
  /** Whether its emergency stop is latched. */
  readonly stopped: boolean;
  /** The main figures in one line. */
  readonly figures: string;
}

/** One or two lines. */
export function captionLines({ epochMs, robot, heard, stopped, figures }: CaptionFacts): readonly string[] {
  const { notLive, noRobot, stopped: stop } = texts().capture;
  const time = `${new Date(epochMs).toISOString().slice(0, 19).replace('T', ' ')} UTC`;
  const first = [time, robot ?? noRobot, ...(heard ? [] : [notLive])].join(' · ');
  // Figures of a robot that is not heard were true a while ago.
  const second = [...(stopped ? [stop] : []), ...(heard && figures !== '' ? [figures] : [])].join(' · ');
  return second === '' ? [first] : [first, second];
}
