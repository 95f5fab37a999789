import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { constantCapacity, idealProfile, type LinkProfile, Random } from '@farpoint/network-sim';
import { type Access, shippedOptions } from '@farpoint/robot-node/testing/drive-core';
import type { WorldDescription } from '@farpoint/sim';
import { Direction } from './direction.ts';
import { EventLog } from './event-log.ts';
import type { GuardSight } from './guard-sight.ts';
import { ScenarioOperator } from './operator.ts';
import { ScenarioRobot } from './robot.ts';
import { Signaling } from './signaling.ts';
import { TimedEvents } from './timed-events.ts';
import { virtualTime } from './virtual-time.ts';
import { plain } from './worlds.ts';

export interface ScenarioOptions {
  seed?: number;
  /** Of each direction; default: 20 Mbit/s, 5 ms. */
  link?: Partial<LinkProfile>;
  /** The robot's command line; default: none, which leaves the limits that ship. */
  args?: readonly string[];
  world?: WorldDescription;
  sight?: GuardSight | null;
}

/** For so long an interval between two pictures counts at the robot, ms. */
const REMEMBERED_MS = 1100;
/** The robot writes what must outlive it to the disk, and waits for that: to memory, where there is a folder of it. */
const memory = existsSync('/dev/shm') ? '/dev/shm' : tmpdir();
const LINK: LinkProfile = { ...idealProfile, capacity: constantCapacity(20), delayMs: 5 };

/**
 * Operators, a link for each, a signaling service and a robot, in virtual time: from its beginning to its disposal, all timers
 * and clocks are its own, and {@link run} moves them on.
 */
export class Scenario implements Disposable {
  /** Called with what happened in each scenario, at its end. */
  static onEnd: ((log: string) => void) | null = null;
  readonly #time = virtualTime();
  readonly log = new EventLog();
  readonly signaling = new Signaling();
  readonly robot: ScenarioRobot;
  readonly operators: ScenarioOperator[] = [];
  readonly #events = new TimedEvents();
  readonly #random: Random;
  readonly #seed: number;
  readonly #link: LinkProfile;
  readonly #folder: string;

  constructor({ seed = 1, link = {}, args = [], world = plain(), sight = null }: ScenarioOptions = {}) {
    [this.#seed, this.#random, this.#link] = [seed, new Random(seed, 9), { ...LINK, ...link }];
    this.#folder = mkdtempSync(join(memory, 'farpoint-scenario-'));
    const { signaling, log } = this;
    const robotOptions = { ...shippedOptions(args), stateFolder: this.#folder };
    this.robot = new ScenarioRobot({ options: robotOptions, world, signaling, log, sight });
    this.robot.onRestart = (session) => {
      for (const { link: each } of this.operators) each.restarted(session);
    };
  }

  /** The operators' clock, `performance.now()`, ms. */
  get nowMs(): number {
    return performance.now();
  }

  /** What a grant lets its holder do, for so long, ms. */
  access(role: NonNullable<Access['role']>, subject: string, lastsMs = 3_600_000): Access {
    const grant = { id: `grant of ${subject}`, subject, keyId: 'k1', issuedAtS: Date.now() / 1000 };
    const expiresAtS = (Date.now() + lastsMs) / 1000;
    return { role, subject, name: subject, expiresAtS, keyId: 'k1', grant };
  }

  /** Lets time pass, ms. */
  run(ms: number): void {
    this.#time.advance(ms);
  }

  /** As {@link run}, for what awaits something: that goes on at each whole millisecond. */
  async settle(ms: number): Promise<void> {
    for (let passed = 0; passed < ms; passed++) {
      this.run(1);
      await othersGoOn();
    }
  }

  /**
   * Does something that may take time, and lets that pass.
   *
   * @returns when it was done
   * @throws what it throws or rejects with, and {Error} if it takes longer than `mostMs`
   */
  async happens(act: () => unknown, mostMs = 60_000): Promise<number> {
    let ended = false;
    const end = () => {
      ended = true;
    };
    const acted = Promise.resolve(act());
    void acted.then(end, end);
    const endMs = this.nowMs + mostMs;
    for (;;) {
      await othersGoOn();
      if (ended) break;
      if (this.nowMs >= endMs) throw new Error(`not done within ${mostMs} ms:\n${this.log.text}`);
      this.run(1);
    }
    await acted;
    return this.nowMs;
  }

  /** Lets time pass until something holds. @throws {Error} if that takes longer than `mostMs` */
  until(is: () => boolean, mostMs = 10_000): void {
    for (const endMs = performance.now() + mostMs; !is(); this.run(1))
      if (performance.now() >= endMs) throw new Error(`not within ${mostMs} ms:\n${this.log.text}`);
  }

  /** An operator with a link of its own, who connects. @param access by its grant; `null`: the robot asks for none */
  operator(name = `operator-${this.operators.length + 1}`, access: Access | null = null): ScenarioOperator {
    const { robot, signaling, log } = this;
    const seed = this.#seed * 16 + this.operators.length * 2;
    const operator = new ScenarioOperator({
      ...{ name, access, robot, signaling, log, random: () => this.#random.next() },
      up: new Direction(this.#events, this.#link, seed),
      down: new Direction(this.#events, this.#link, seed + 1),
    });
    this.operators.push(operator);
    operator.client.start();
    operator.client.choose(robot.id);
    return operator;
  }

  /** A connected operator. */
  connected(name?: string, access?: Access): ScenarioOperator {
    const operator = this.operator(name, access);
    this.until(() => operator.client.phase === 'live' && operator.client.telemetry !== null);
    return operator;
  }

  /** An operator who drives ahead at this share of full speed, for longer than the robot remembers what it saw. */
  driving(share = 0.5, access?: Access): ScenarioOperator {
    const operator = this.connected(undefined, access);
    const { hand } = operator;
    this.run(100);
    hand.push(share);
    const speed = this.robot.core.host.drive.guard.limits.maxLinear * share;
    this.until(() => Math.abs(this.robot.wheels.speed - speed) < 1e-6);
    this.run(REMEMBERED_MS);
    return operator;
  }

  [Symbol.dispose](): void {
    for (const operator of this.operators) operator.close();
    this.robot.close();
    Scenario.onEnd?.(this.log.text);
    rmSync(this.#folder, { recursive: true, force: true });
    this.#time[Symbol.dispose]();
  }
}

/** Whatever waits for a timer of the last millisecond goes on. */
async function othersGoOn(): Promise<void> {
  for (let turns = 0; turns < 10; turns++) await Promise.resolve();
}
