/** The gamepads, wheels and joysticks that the browser shows now. */
import { controllerKey } from './input-choices.ts';

export interface KeyedPad {
  /** Under which what was chosen for it is kept. */
  readonly key: string;
  readonly pad: Gamepad;
}

/** Reads them anew at each call: a browser shows a gamepad once one of its buttons was pressed. */
export function connectedPads(): KeyedPad[] {
  const pads = navigator.getGamepads?.() ?? [];
  return pads.flatMap((pad) =>
    pad === null || pad.connected === false ? [] : [{ key: controllerKey(pad), pad }],
  );
}
