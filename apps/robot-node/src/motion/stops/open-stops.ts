import type { GpioLineAt } from '@farpoint/gpio';
import type { RobotStop } from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import { GpioStop } from './gpio-stop.ts';
import { KeyStop } from './key-stop.ts';
import { ShmStop, type ShmStopOptions } from './shm-stop.ts';
import type { StopSource } from './stop-source.ts';
import { TopicStop, type TopicStopOptions } from './topic-stop.ts';

/** The stops at the robot that are configured. */
export interface RobotStopsOptions {
  topic?: TopicStopOptions | undefined;
  shm?: ShmStopOptions | undefined;
  gpio?: GpioLineAt | undefined;
  /** A key on the console. */
  key: boolean;
}

export function isConfigured(options: RobotStopsOptions, stop: RobotStop): boolean {
  return stop === 'key' ? options.key : options[stop] !== undefined;
}

/** @param remembered the stops that held the emergency stop when the robot last ran */
export function openStops(
  { topic, shm, gpio, key }: RobotStopsOptions,
  remembered: readonly RobotStop[],
  log: Logger,
): StopSource[] {
  const sources: StopSource[] = [];
  if (topic !== undefined) sources.push(new TopicStop(topic, log));
  if (shm !== undefined) sources.push(new ShmStop(shm));
  if (gpio !== undefined) sources.push(new GpioStop(gpio));
  if (key) {
    const interrupt = () => process.kill(process.pid, 'SIGINT');
    sources.push(new KeyStop(process.stdin, remembered.includes('key'), interrupt));
    log.info('every key on this console stops the robot; `release` and Enter release it');
  }
  return sources;
}
