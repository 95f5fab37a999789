/** What the first drive asks for, by the keys, buttons or fingers that this operator has. */
import { type KeyMap, type KeyRole, mainKey } from '../take/drive/key-map.ts';
import type { LatchedStop } from './estop-words.ts';
import { controllerParts, type HelpController } from './help-rows.ts';
import { keyName } from './input-words.ts';
import { laterTexts, texts } from './language.ts';

export const TOUR_STEPS = ['grip', 'drive', 'stop', 'release'] as const;
export type TourStep = (typeof TOUR_STEPS)[number];

export interface TourFacts {
  readonly keys: KeyMap;
  /** The controller that can drive; `null` if none is connected. */
  readonly controller: HelpController | null;
  /** Whether this operator has fingers on a screen, and no keyboard. */
  readonly touch: boolean;
  /** Whether this operator's grant only lets it watch. */
  readonly watches: boolean;
  /** Whether another operator drives. */
  readonly otherDrives: boolean;
  /** The emergency stop; `null` while it is off. */
  readonly stop: LatchedStop | null;
  /** What keeps the robot from moving although the grip is held; `null` if nothing does. */
  readonly heldBy: string | null;
}

/** What the operator does in this step; or what keeps the step from being done. */
export function tourLine(step: TourStep | 'done', facts: TourFacts): string {
  const { tour } = laterTexts().help;
  if (step === 'done') return tour.done;
  return tour.step(TOUR_STEPS.indexOf(step) + 1, TOUR_STEPS.length, sentence(step, facts));
}

function sentence(step: TourStep, facts: TourFacts): string {
  const { tour } = laterTexts().help;
  const { stop, heldBy } = facts;
  if (stop !== null && (step !== 'release' || !stop.mayRelease)) return tour.stopIsOn(stop.why, stop.release);
  switch (step) {
    case 'grip':
      return refusal(facts) ?? `${gripSentence(facts)} ${tour.why}`;
    case 'drive': {
      const how = refusal(facts) ?? driveSentence(facts);
      return heldBy === null ? how : tour.heldBy(how, heldBy);
    }
    case 'stop':
      return facts.touch ? tour.stopFinger : tour.stop(named('estop', facts));
    case 'release': {
      const names = named('release', facts);
      return facts.touch || names === '' ? tour.releaseFinger : tour.release(names);
    }
  }
}

/** Why nobody but another drives; `null` if this operator may. */
function refusal({ watches, otherDrives }: TourFacts): string | null {
  const { rejections } = texts().driving;
  if (watches) return rejections['not-permitted'];
  return otherDrives ? rejections['not-lease-holder'] : null;
}

function gripSentence(facts: TourFacts): string {
  const { tour } = laterTexts().help;
  if (facts.touch) return tour.gripFinger;
  const names = named('grip', facts);
  return names === '' ? tour.gripUnset : tour.grip(names);
}

function driveSentence({ keys, touch, controller }: TourFacts): string {
  const { tour } = laterTexts().help;
  if (touch) return tour.driveFinger;
  const ways = (['forward', 'left', 'back', 'right'] as const).flatMap((role) => mainKey(keys, role) ?? []);
  const stick = controller === null ? undefined : controllerParts('forward', controller)[0];
  const names = ways.map(keyName);
  if (controller !== null && stick !== undefined) names.push(tour.ofDevice(stick, controller.name));
  return names.length === 0 ? tour.driveStick : tour.drive(oneOf(names));
}

/** The keys of a role; with a controller, one key and its button. Empty if there is neither. */
function named(role: KeyRole, { keys, controller }: TourFacts): string {
  const button = controller === null ? undefined : controllerParts(role, controller)[0];
  if (controller === null || button === undefined) return oneOf(keys[role].map(keyName));
  const key = mainKey(keys, role);
  const names = key === undefined ? [] : [keyName(key)];
  return oneOf([...names, laterTexts().help.tour.ofDevice(button, controller.name)]);
}

function oneOf(names: readonly string[]): string {
  const [last = '', ...others] = names.toReversed();
  return others.length === 0 ? last : laterTexts().help.tour.or(others.reverse().join(', '), last);
}
