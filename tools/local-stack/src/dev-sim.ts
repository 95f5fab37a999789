/** How much the simulated robot of `pnpm dev` simulates: it shares the computer with the page that shows it. */

/** A side of the simulated depth camera's image in pixels, and its images a second. */
interface SimLoad {
  cores: number;
  size: number;
  fps: number;
}

/** For at least so many processor cores, the most first. */
const LOADS: readonly SimLoad[] = [
  { cores: 8, size: 480, fps: 60 },
  { cores: 4, size: 480, fps: 30 },
  { cores: 1, size: 240, fps: 20 },
];

/**
 * The simulated robot's arguments. All programs are equals: on a robot of its own the robot goes before other programs, but
 * here it would take the time of the page and of the operator's hand.
 *
 * @param cores that the computer has
 */
export function simArguments(cores: number): string[] {
  const { size, fps } = LOADS.find((load) => cores >= load.cores) ?? (LOADS.at(-1) as SimLoad);
  return ['--source', 'sim', '--sim-size', String(size), '--fps', String(fps), '--niceness', '0'];
}
