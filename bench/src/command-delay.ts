/** How long commands took from the page to the robot, by the robot's log of them. */
import { readFileSync } from 'node:fs';

export interface CommandDelays {
  /** Delays beyond the link's own, ms, of commands that the robot took. */
  readonly accepted: number[];
  /** Commands that came, but moved nothing: too late, out of order, or without the lease. */
  readonly refused: number;
}

/**
 * @param path of the `commands.csv` that the robot writes with `--measure`
 * @param offsetMs what to add to the page's clock to get the robot's
 * @param linkMs the link's own delay in that direction
 * @param time of the robot's clock: what was sent in it counts
 */
export function commandDelays(
  path: string,
  offsetMs: number,
  linkMs: number,
  [fromMs, toMs]: readonly [number, number],
): CommandDelays {
  const [header, ...lines] = readFileSync(path, 'utf8').trimEnd().split('\n');
  if (header !== 'sequence,sentMs,receivedMs,accepted') throw new Error(`${path}: not a command log`);
  const accepted: number[] = [];
  let refused = 0;
  for (const line of lines) {
    const [, sentMs, receivedMs, isAccepted] = line.split(',').map(Number) as [
      number,
      number,
      number,
      number,
    ];
    const sentAtMs = sentMs + offsetMs;
    if (sentAtMs < fromMs || sentAtMs >= toMs) continue;
    if (isAccepted === 1) accepted.push(receivedMs - sentAtMs - linkMs);
    else refused++;
  }
  return { accepted, refused };
}
