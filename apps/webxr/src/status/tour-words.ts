/** What the first drive asks for, by the keys that are chosen. */
import type { KeyMap } from '../drive/key-map.ts';
import { TOUR_STEPS, type TourStep } from '../tour/first-drive.ts';
import type { LatchedStop } from './estop-words.ts';
import { keyName } from './input-words.ts';
import { rejectionWords } from './words.ts';

export const tourWords = {
  title: 'First drive',
  skip: 'Skip this step',
  end: 'End the tour',
  close: 'Close',
  done: 'That was all: hold the grip, drive, STOP, release. Help lists every key and button.',
} as const;

export interface TourFacts {
  readonly keys: KeyMap;
  /** Whether a key for a direction is the grip as well. */
  readonly oneHanded: boolean;
  /** Whether this operator has fingers on a screen, and no keyboard. */
  readonly touch: boolean;
  /** Whether another operator drives. */
  readonly otherDrives: boolean;
  /** The emergency stop; `null` while it is off. */
  readonly stop: LatchedStop | null;
  /** What keeps the robot from moving although it is told to; `null` if nothing does. */
  readonly heldBy: string | null;
}

/** What the operator is asked to do now; or what has to be done first. */
export function tourLine(step: TourStep | 'done', facts: TourFacts): string {
  if (step === 'done') return tourWords.done;
  return `Step ${TOUR_STEPS.indexOf(step) + 1} of ${TOUR_STEPS.length}: ${sentence(step, facts)}`;
}

function sentence(step: TourStep, facts: TourFacts): string {
  const { stop, otherDrives, heldBy } = facts;
  if (step === 'release')
    return stop === null || stop.mayRelease ? releaseSentence(facts) : `${stop.why} ${stop.release}`;
  if (stop !== null) return `the emergency stop is on. ${stop.why} ${stop.release}`;
  if (step === 'stop') return stopSentence(facts);
  if (otherDrives) return rejectionWords['not-lease-holder'];
  if (step === 'grip') return gripSentence(facts);
  const how = driveSentence(facts);
  return heldBy === null ? how : `${how} It does not move now. ${heldBy}.`;
}

function gripSentence({ keys, touch, oneHanded }: TourFacts): string {
  const why = 'The robot moves only while you do, and stops when you let go.';
  if (touch) return `put a finger on the joystick and keep it there. ${why}`;
  if (oneHanded) return `hold ${oneOf(directions(keys))}: it is the grip as well. ${why}`;
  const grip = keys.grip.map(keyName);
  if (grip.length === 0) return `hold the grip of your controller; no key is one. ${why}`;
  return `hold ${oneOf(grip)}: the grip. ${why}`;
}

function driveSentence({ keys, touch, oneHanded }: TourFacts): string {
  if (touch) return 'keep the finger down and push: the robot drives.';
  const held = oneHanded ? 'hold' : 'with the grip held, press';
  const ways = directions(keys);
  return ways.length === 0
    ? 'with the grip held, move the stick: the robot drives.'
    : `${held} ${oneOf(ways)}: the robot drives.`;
}

function stopSentence({ keys, touch }: TourFacts): string {
  const what = 'it stops at once, whatever anybody holds';
  if (touch) return `press STOP: ${what}.`;
  return `press ${oneOf(keys.estop.map(keyName))} or the STOP button: ${what}.`;
}

function releaseSentence({ keys, touch }: TourFacts): string {
  const names = keys.release.map(keyName);
  const key = touch || names.length === 0 ? '' : `${oneOf(names)} or `;
  return `hold ${key}“Hold to release” for one second. A grip has to be let go before it drives again.`;
}

/** The first key of each direction. */
function directions({ forward, left, back, right }: KeyMap): string[] {
  return [forward, left, back, right].flatMap(([first]) => (first === undefined ? [] : [keyName(first)]));
}

function oneOf(names: readonly string[]): string {
  return names.length < 2 ? (names[0] ?? '') : `${names.slice(0, -1).join(', ')} or ${names.at(-1)}`;
}
