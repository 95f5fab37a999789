import type { Cue } from './cue-judge.ts';

/** How hard, 0–1, and how long. */
const cuePulses: Readonly<Record<Cue, { strength: number; ms: number }>> = {
  slower: { strength: 0.4, ms: 60 },
  held: { strength: 1, ms: 150 },
  stop: { strength: 1, ms: 400 },
};

/** What browsers know to vibrate: headset controllers, gamepads, phones. */
interface Vibrating {
  hapticActuators?: readonly { pulse?: (strength: number, ms: number) => unknown }[] | undefined;
  vibrationActuator?: Pick<GamepadHapticActuator, 'playEffect'> | null | undefined;
}

/** Lets whatever the operator holds vibrate; what cannot stays silent. */
export function vibrate(cue: Cue, controllers: Iterable<Vibrating | null | undefined>): void {
  const { strength, ms } = cuePulses[cue];
  let held = false;
  for (const controller of controllers) {
    const [actuator] = controller?.hapticActuators ?? [];
    if (actuator?.pulse !== undefined) {
      held = true;
      quietly(actuator.pulse(strength, ms));
    } else if (controller?.vibrationActuator != null) {
      held = true;
      const effect = { duration: ms, strongMagnitude: strength, weakMagnitude: strength };
      quietly(controller.vibrationActuator.playEffect('dual-rumble', effect));
    }
  }
  // Only a phone vibrates by itself.
  if (!held) navigator.vibrate?.(ms);
}

/** An effect that is replaced by the next one rejects. */
function quietly(result: unknown): void {
  if (result instanceof Promise) result.catch(() => undefined);
}
