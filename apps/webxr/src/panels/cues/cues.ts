/**
 * Lets the operator hear and feel that the robot does less than it is told, wherever they look; and in the headset feel that
 * there is something to read.
 */
import type { RobotClient } from '@farpoint/operator';
import { effect } from '@preact/signals-core';
import type { Hand } from '../../ground/headset-settings.ts';
import type { Settings } from '../../ground/settings.ts';
import type { VrSession } from '../../scene/view/vr-session.ts';
import type { PageState } from '../../state/page-state.ts';
import { type Cue, CueJudge } from './cue-judge.ts';
import { CueSound } from './cue-sound.ts';
import { NoticeJudge } from './notice-judge.ts';

/** How hard, 0–1, and how long, ms. */
interface Pulse {
  readonly strength: number;
  readonly ms: number;
}

const cuePulses: Readonly<Record<Cue, Pulse>> = {
  slower: { strength: 0.4, ms: 60 },
  held: { strength: 1, ms: 150 },
  stop: { strength: 1, ms: 400 },
};
/** Chosen: told from a robot that is only slower, and weaker than one that is held. */
const NOTICE_PULSE: Pulse = { strength: 0.6, ms: 100 };

/** Chosen: a tick, weaker than any warning. */
const DONE_PULSE: Pulse = { strength: 0.3, ms: 40 };

/** What browsers know to vibrate: headset controllers, gamepads, phones. */
interface Vibrating {
  hapticActuators?: readonly { pulse?: (strength: number, ms: number) => unknown }[] | undefined;
  vibrationActuator?: Pick<GamepadHapticActuator, 'playEffect'> | null | undefined;
}

/** Lets whatever the operator holds vibrate; what cannot stays silent. */
function vibrate({ strength, ms }: Pulse, controllers: Iterable<Vibrating | null | undefined>): void {
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

export interface CueParts {
  readonly client: RobotClient;
  readonly vr: VrSession;
  /** Are read at each cue. */
  readonly settings: Pick<Settings, 'cues'>;
  readonly state: {
    readonly notices: Pick<PageState['notices'], 'last'>;
    readonly link: Pick<PageState['link'], 'banner' | 'obstacle'>;
  };
  /** Page's clock, ms. */
  now(): number;
}

export function giveCues({ client, vr, settings, state, now }: CueParts): void {
  let judge = new CueJudge();
  const notices = new NoticeJudge();
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
    notices.onFelt(now());
    const gamepads = vr.active.peek() ? gamepadsOf(vr.inputSources) : (navigator.getGamepads?.() ?? []);
    vibrate(cuePulses[cue], gamepads);
  };
  client.on('session', () => {
    judge = new CueJudge();
  });
  client.on('welcome', () => {
    if (settings.cues) sound.prepare();
  });
  client.on('telemetry', look);
  client.on('estop', look);
  /** On the flat page, notices are before the eyes already. */
  const feel = () => {
    if (vr.active.peek() && settings.cues) vibrate(NOTICE_PULSE, gamepadsOf(vr.inputSources));
  };
  effect(() => {
    const words = state.notices.last.value;
    if (words !== null && notices.next(words, now())) feel();
  });
  effect(() => {
    const { banner, obstacle } = state.link;
    if (notices.onStanding((banner.value ?? obstacle.value) !== null, now())) feel();
  });
}

/** A hand feels that what it did is done. @param vr whose controller it holds; `null`: a finger on the screen */
export function feelDone(
  settings: Pick<Settings, 'cues'>,
  vr: Pick<VrSession, 'inputSources'> | null,
  hand?: Hand,
): void {
  if (!settings.cues) return;
  const sources = [...(vr?.inputSources ?? [])].filter(({ handedness }) => handedness === hand);
  if (vr === null || sources.length > 0) vibrate(DONE_PULSE, gamepadsOf(sources));
}

function gamepadsOf(sources: Iterable<XRInputSource>): (Gamepad | undefined)[] {
  return [...sources].map(({ gamepad }) => gamepad);
}
