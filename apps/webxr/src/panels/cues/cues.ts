/** Lets the operator hear and feel that the robot does less than it is told, wherever they look. */
import type { RobotClient } from '@farpoint/operator';
import type { Settings } from '../../ground/settings.ts';
import type { VrSession } from '../../scene/view/vr-session.ts';
import { type Cue, CueJudge } from './cue-judge.ts';
import { CueSound } from './cue-sound.ts';

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

/** @param settings are read at each cue */
export function giveCues(
  client: RobotClient,
  vr: VrSession,
  settings: Pick<Settings, 'cues'>,
  now: () => number,
): void {
  let judge = new CueJudge();
  const sound = new CueSound();
  const look = () => {
    const { session, phase } = client.link;
    if (phase !== 'live') return;
    const { telemetry, estop } = session;
    const cue = judge.next(
      {
        driving: client.driver.stream.held,
        latched: estop.latched,
        drive: telemetry?.drive ?? 'idle',
        motion: telemetry?.motion,
      },
      now(),
    );
    if (cue === null || !settings.cues) return;
    sound.play(cue);
    vibrate(cue, vr.active.value ? gamepadsOf(vr.inputSources) : (navigator.getGamepads?.() ?? []));
  };
  client.on('session', () => {
    judge = new CueJudge();
  });
  client.on('telemetry', look);
  client.on('estop', look);
}

function gamepadsOf(sources: Iterable<XRInputSource>): (Gamepad | undefined)[] {
  return [...sources].map(({ gamepad }) => gamepad);
}
