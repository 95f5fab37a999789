/** The robots that this browser knows by their keys. Not secret. */
import type { KnownRobots } from '@farpoint/operator';
import { robotIdSchema } from '@farpoint/protocol';
import * as z from 'zod/mini';

const KEY = 'farpoint.robots';
/** For each signaling service; beyond it, those that were met longest ago are forgotten. */
const MOST_ROBOTS = 256;
const MOST_SERVICES = 32;

const thumbprint = z.string().check(z.regex(/^[A-Za-z0-9_-]{43}$/));
const robotsSchema = z.array(z.tuple([robotIdSchema, thumbprint])).check(z.maxLength(MOST_ROBOTS));
const schema = z.array(z.tuple([z.string().check(z.maxLength(512)), robotsSchema]));

/** Thumbprints by robot id, by the service's origin; those met last come last. */
export type RobotKeys = ReadonlyMap<string, ReadonlyMap<string, string>>;

/** Nothing is known if the text is not what {@link robotKeysText} writes. */
export function parseRobotKeys(text: string | null): RobotKeys {
  let value: unknown = null;
  try {
    value = JSON.parse(text ?? '[]');
  } catch {
    return new Map();
  }
  const { success, data } = schema.safeParse(value);
  return new Map(success ? data.map(([origin, robots]) => [origin, new Map(robots)]) : []);
}

/** What {@link parseRobotKeys} reads. */
export function robotKeysText(keys: RobotKeys): string {
  return JSON.stringify([...keys].map(([origin, robots]) => [origin, [...robots]]));
}

/** @param key `null` forgets the robot */
export function withRobotKey(
  keys: RobotKeys,
  origin: string,
  robotId: string,
  key: string | null,
): RobotKeys {
  const robots = new Map(keys.get(origin));
  robots.delete(robotId);
  if (key !== null) robots.set(robotId, key);
  const next = new Map(keys);
  next.delete(origin);
  if (robots.size > 0) next.set(origin, new Map([...robots].slice(-MOST_ROBOTS)));
  return new Map([...next].slice(-MOST_SERVICES));
}

/** The robots of one signaling service. Read anew each time, because other tabs write, too. */
export class StoredRobots implements KnownRobots {
  readonly #origin: string;
  /** Where the browser stores nothing, robots are known for this visit only. */
  #memory: RobotKeys = new Map();

  /** @param origin of the signaling service */
  constructor(origin: string) {
    this.#origin = origin;
  }

  get(robotId: string): string | undefined {
    return this.#load().get(this.#origin)?.get(robotId);
  }

  remember(robotId: string, key: string): void {
    this.#change(robotId, key);
  }

  forget(robotId: string): void {
    this.#change(robotId, null);
  }

  /** Thumbprints by robot id. */
  all(): ReadonlyMap<string, string> {
    return this.#load().get(this.#origin) ?? new Map();
  }

  #load(): RobotKeys {
    try {
      return parseRobotKeys(localStorage.getItem(KEY));
    } catch {
      return this.#memory;
    }
  }

  #change(robotId: string, key: string | null): void {
    const next = withRobotKey(this.#load(), this.#origin, robotId, key);
    this.#memory = next;
    try {
      localStorage.setItem(KEY, robotKeysText(next));
    } catch {
      // Private browsing.
    }
  }
}
