/** What the page says to a hand on the controls that moves nothing. */
import type { DriveInput, GripLoss } from '@farpoint/operator';
import type { LeaseState, Role } from '@farpoint/protocol';
import { mainKey } from '../take/drive/key-map.ts';
import { inputSettings } from '../take/drive/stored-inputs.ts';
import { keyName } from './input-words.ts';
import { texts } from './language.ts';

/** A stick or key is pushed without a grip. @returns what has to be done first */
export function missingGripWords(
  device: DriveInput['name'],
  holder: LeaseState['holder'],
  role: Role | null,
): string {
  const { grip, gripMissing, holdKey, rejections } = texts().driving;
  if (role === 'watch') return rejections['not-permitted'];
  if (holder === 'other') return rejections['not-lease-holder'];
  const key = mainKey(inputSettings.keys.peek(), 'grip');
  return gripMissing(device === 'keyboard' && key !== undefined ? holdKey(keyName(key)) : grip[device]);
}

/** Another has taken the lease. @param driver its name, by its grant; empty if it has none */
export function takenOverWords(driver: string | null): string {
  const { takenOver, anotherOperator } = texts().driving;
  return takenOver(driver || anotherOperator);
}

export interface HandFacts {
  /** Why the grip that is held does not drive; `null` if it does, or if none is. */
  gripLost: GripLoss | null;
  /** Who took over while the grip was held, '' without a name; `null`: nobody did, or it has been opened since. */
  takenOverBy: string | null;
}

/** What a hand is told as long as it holds on in vain; `null` if it does not. */
export function vainGripWords({ gripLost, takenOverBy }: HandFacts): { title: string; text: string } | null {
  const said = texts().driving;
  if (takenOverBy !== null)
    return { title: said.takenOverTitle, text: `${takenOverWords(takenOverBy)} ${said.letGo}` };
  return gripLost === null ? null : { title: said.letGoTitle, text: said.gripLost[gripLost] };
}
