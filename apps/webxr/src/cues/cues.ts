/** Lets the operator hear and feel that the robot does less than it is told, wherever they look. */
import type { RobotClient } from '@farpoint/operator';
import type { Settings } from '../settings.ts';
import type { VrSession } from '../view/vr-session.ts';
import { vibrate } from './cue-haptics.ts';
import { CueJudge } from './cue-judge.ts';
import { CueSound } from './cue-sound.ts';

/** @param settings whether cues are given, as it is at each of them */
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
    vibrate(cue, vr.active.value ? vr.gamepads() : (navigator.getGamepads?.() ?? []));
  };
  client.on('session', () => {
    judge = new CueJudge();
  });
  client.on('telemetry', look);
  client.on('estop', look);
}
