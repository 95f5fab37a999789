/** Shows before the operator's eyes in the headset what the page says to its operator. */
import { computed, effect, type ReadonlySignal } from '@preact/signals-core';
import type { HeadsetSettings } from '../../ground/headset-settings.ts';
import type { PageState } from '../../state/page-state.ts';
import { choiceWords, headsetNotice } from '../../words/headset-notice-words.ts';
import type { HeadsetRig } from './headset-rig.ts';
import type { NoticeSign } from './notice-sign.ts';

export interface NoticeParts {
  readonly state: Pick<PageState, 'notices' | 'link' | 'robot' | 'sampledAtMs'>;
  readonly sign: NoticeSign;
  readonly headset: Pick<HeadsetRig, 'view'>;
  readonly settings: Pick<HeadsetSettings, 'driveHand'>;
  /** Whether VR is active. */
  readonly active: ReadonlySignal<boolean>;
  /** Whether the operator holds a grip. */
  isGripped(): boolean;
}

export function showNoticesInVr(parts: NoticeParts): void {
  const { state, sign, headset, settings, active, isGripped } = parts;
  const { notices, link, robot, sampledAtMs } = state;
  const held = computed(() => {
    const motion = robot.motion.value;
    return motion?.tone === 'bad' && sampledAtMs.value >= 0 && isGripped() ? motion : null;
  });
  const choice = computed(() => {
    if (link.connected.value) return null;
    const { driveHand } = settings;
    return choiceWords({
      next: link.nextRobot.value,
      signaling: link.signaling.value,
      host: link.host,
      driveHand,
    });
  });
  effect(() => {
    if (!active.value) {
      sign.clear();
      return;
    }
    sign.say(
      headsetNotice({
        failure: notices.failure.value,
        banner: link.banner.value,
        obstacle: link.obstacle.value,
        stop: robot.latchedStop.value,
        held: held.value,
        choice: choice.value,
        notice: notices.shown.value,
        view: headset.view.value,
        driveHand: settings.driveHand,
      }),
    );
  });
}
