/** How long commands took from the page to the robot, by the robot's log of them. */
import { readFileSync } from 'node:fs';

/**
 * @param path of the robot's `--command-log`
 * @param offsetMs what to add to the page's clock to get the robot's
 * @param linkMs the link's own delay in that direction
 * @returns the delays beyond the link's own, of commands sent in the given time on the robot's clock, ms
 */
export function commandDelays(
  path: string,
  offsetMs: number,
  linkMs: number,
  [fromMs, toMs]: readonly [number, number],
): number[] {
  const [header, ...lines] = readFileSync(path, 'utf8').trimEnd().split('\n');
  if (header !== 'sequence,sentMs,receivedMs,accepted') throw new Error(`${path}: not a command log`);
  return lines.flatMap((line) => {
    const [, sentMs, receivedMs] = line.split(',').map(Number) as [number, number, number];
    const sentAtMs = sentMs + offsetMs;
    return sentAtMs >= fromMs && sentAtMs < toMs ? [receivedMs - sentAtMs - linkMs] : [];
  });
}
