/** What the operator's hand does in `pnpm bench prediction`: a drive at up to 1 m/s with turns, stops and a stick. */

/** Until `endS` of the round: m/s and rad/s, as of a key, or as of a stick. */
type Part = readonly [endS: number, linear: number, angular: number] | readonly [endS: number, wish: Stick];
type Stick = (s: number) => readonly [linear: number, angular: number];

/** No multiples of a display frame: keys come at any time within it. */
const PARTS: readonly Part[] = [
  [0.807, 0, 0],
  [3.811, 1, 0],
  [5.302, 0, 0],
  [7.309, 0, 0.8],
  [8.313, 0, 0],
  [11.304, 1, 0.5],
  [13.308, 1, -0.6],
  [14.511, 0, 0],
  [16.002, -0.5, 0],
  [17.006, 0, 0],
  [18.003, 0, -0.8],
  [19.009, 0, 0.8],
  [20.012, 0, 0],
  [25.001, (s) => [0.6 - 0.4 * Math.cos(2 * s), 0.7 * Math.sin(1.7 * s)]],
  [26.007, 0, 0],
];
export const ROUND_S = 26.007;

/** A session that begins with a turn, as fast as the robot turns: the worst that can be asked of an unknown base. */
export function firstTurnAt(seconds: number): readonly [linear: number, angular: number] {
  return [0, seconds >= 0.807 && seconds < 2.809 ? 1.5 : 0];
}
/** From the turn until the robot has come to rest, and until that is seen, s. */
export const FIRST_TURN_S = { from: 0.807, to: 3.81 };

/** The hand's wish, m/s and rad/s. @param seconds since the drive began */
export function handAt(seconds: number): readonly [linear: number, angular: number] {
  const s = seconds % ROUND_S;
  const part = PARTS.find(([endS]) => s < endS);
  if (part === undefined) return [0, 0];
  return part.length === 2 ? part[1](s) : [part[1], part[2]];
}
