/** Lets the operator hear and feel that the robot does less than it is told, wherever they look. */
import type { RobotClient } from '@farpoint/operator';
import type { VrSession } from '../../scene/view/vr-session.ts';
import { vibrate } from './cue-haptics.ts';
import { CueJudge } from './cue-judge.ts';
import { CueSound } from './cue-sound.ts';

export function giveCues(client: RobotClient, vr: VrSession, now: () => number): void {
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
    if (cue === null) return;
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
