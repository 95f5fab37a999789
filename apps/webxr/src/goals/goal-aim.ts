import type { Words } from '../status/tone.ts';
import type { FloorPlace } from './floor-pick.ts';

/** Names goals by other means than the page's pointer, and tells of them there. */
export interface GoalAim {
  /** What is said at the goal; empty while nothing is. */
  readonly said: string;
  /** Where the operator aims, and what that means; `null` while nobody does. Call this at the rate of the commands. */
  tick(nowMs: number): { place: FloorPlace | null; words: Words } | null;
  /** @param ground height of the robot's ground, m */
  say(place: FloorPlace | null, words: Words | null, ground: number): void;
}
