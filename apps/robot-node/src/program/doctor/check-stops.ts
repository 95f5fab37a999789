/** Checks the stops at the robot itself: one that cannot be read keeps the robot standing. */
import { openGpioLine } from '@farpoint/gpio';
import { StopBlock } from '@farpoint/shared-memory';
import type { RobotStopsOptions } from '../../motion/stops/open-stops.ts';
import { fail, ok, type Result, warn } from './finding.ts';

/** What is read of the machine, so that tests need none. */
export interface StopsHost {
  /** Whether the robot would read keys one by one. */
  readonly isTerminal: boolean;
  wait(ms: number): Promise<void>;
}

const STANDS = 'the robot stands until it can be read';

/** @param robotRuns a running robot holds the line. The topic is checked with the other topics. */
export async function checkStops(
  { shm, gpio, key }: RobotStopsOptions,
  robotRuns: boolean,
  host: StopsHost,
): Promise<Result[]> {
  const results: Result[] = [];
  if (shm !== undefined) results.push(await checkBlock(shm, host));
  if (gpio !== undefined && !robotRuns) results.push(checkLine(gpio));
  if (key)
    results.push(
      host.isTerminal
        ? ok('stop (console): a terminal')
        : warn(
            'stop (console): this is no terminal, and the robot needs one, or a pipe, that stays open',
            'start the robot in a terminal, or leave out --stop-key; systemd gives services no console',
          ),
    );
  return results;
}

async function checkBlock(
  { path, owner, silentMs }: NonNullable<RobotStopsOptions['shm']>,
  host: StopsHost,
): Promise<Result> {
  try {
    using block = StopBlock.open(path, owner);
    const before = block.read();
    await host.wait(silentMs);
    const { counter, stop } = block.read();
    if (counter === before.counter)
      return fail(
        `stop (shared memory): the counter of ${path} stands still: ${STANDS}`,
        'start the program that writes it; docs/shared-memory.md describes the layout',
      );
    if (stop)
      return warn(`stop (shared memory): ${path} says stop`, 'release the stop, or the robot starts stopped');
    return ok(`stop (shared memory): ${path} is written`);
  } catch (error) {
    return fail(
      `stop (shared memory): ${(error as Error).message}: ${STANDS}`,
      'start the program that writes it; docs/shared-memory.md describes the layout',
    );
  }
}

function checkLine(gpio: NonNullable<RobotStopsOptions['gpio']>): Result {
  const name = `${gpio.chip} line ${gpio.line}`;
  try {
    const line = openGpioLine(gpio);
    try {
      if (line.isActive())
        return warn(
          `stop (GPIO): ${name} is active`,
          'release the stop; if it is released, change :active-low in --stop-gpio',
        );
      return ok(`stop (GPIO): ${name} can be read, and is not active`);
    } finally {
      line.close();
    }
  } catch (error) {
    return fail(
      `stop (GPIO): ${(error as Error).message}: ${STANDS}`,
      '`gpioinfo` lists chips and lines; correct --stop-gpio, or the permissions of the chip; a container needs `--device` and `--group-add`',
    );
  }
}
