/** Shows before the operator's eyes in the headset what the page says to its operator. */
import { computed, effect, type ReadonlySignal } from '@preact/signals-core';
import type { HeadsetSettings } from '../../ground/headset-settings.ts';
import type { PageState } from '../../state/page-state.ts';
import { askedWords } from '../../words/handover-words.ts';
import { choiceWords, headsetNotice } from '../../words/headset-notice-words.ts';
import type { HeadsetRig } from './headset-rig.ts';
import type { NoticeSign } from './notice-sign.ts';

export interface NoticeParts {
  readonly state: Pick<PageState, 'notices' | 'link' | 'robot' | 'people' | 'sampledAtMs'>;
  readonly sign: NoticeSign;
  readonly headset: Pick<HeadsetRig, 'view'>;
  readonly settings: Pick<HeadsetSettings, 'driveHand'>;
  /** Whether the headset's menu is open. */
  readonly menuOpen: ReadonlySignal<boolean>;
  /** Whether VR is active. */
  readonly active: ReadonlySignal<boolean>;
  /** Whether the operator holds a grip. */
  isGripped(): boolean;
}

export function showNoticesInVr(parts: NoticeParts): void {
  const { state, sign, headset, settings, menuOpen, active, isGripped } = parts;
  const { notices, link, robot, people, sampledAtMs } = state;
  const held = computed(() => {
    const motion = robot.motion.value;
    return motion?.tone === 'bad' && sampledAtMs.value >= 0 && isGripped() ? motion : null;
  });
  const choice = computed(() => {
    if (link.connected.value) return null;
    const { driveHand } = settings;
    return choiceWords({
      next: link.nextRobot.value,
      others: link.robots.value.length > 1,
      signaling: link.signaling.value,
      host: link.host,
      driveHand,
    });
  });
  /** Without the seconds that are left: what stands is not drawn anew for each. */
  const asked = computed(() => {
    const request = people.asked.value;
    return request === null ? null : askedWords(request).text;
  });
  effect(() => {
    sign.lowered = menuOpen.value;
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
        asked: asked.value,
        menuOpen: menuOpen.value,
        choice: choice.value,
        notice: notices.shown.value,
        view: headset.view.value,
        driveHand: settings.driveHand,
      }),
    );
  });
}
