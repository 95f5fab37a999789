/** Shows the page's notices in the headset, and lets the hands feel each refusal. */
import { computed, effect, type ReadonlySignal, untracked } from '@preact/signals-core';
import type { PageState } from '../../state/page-state.ts';
import { askedWords } from '../../status/handover-words.ts';
import { headsetNotice } from '../../status/headset-notice-words.ts';
import type { Tone } from '../../status/tone.ts';
import type { NoticeSign } from './notice-sign.ts';

const FELT: ReadonlySet<Tone> = new Set(['warning', 'bad']);

export interface NoticeParts {
  readonly state: Pick<PageState, 'notices' | 'link' | 'robot' | 'driving' | 'people'>;
  readonly sign: NoticeSign;
  /** Whether VR is active. */
  readonly active: ReadonlySignal<boolean>;
  /** Lets the controllers vibrate. */
  pulse(): void;
}

export function showNoticesInVr({ state, sign, active, pulse }: NoticeParts): void {
  const { notices, link, robot, driving, people } = state;
  const asked = computed(() => {
    const handover = people.asked.value;
    return handover === null ? null : askedWords(handover).text;
  });
  effect(() => {
    if (!active.value) return;
    const motion = robot.motion.value;
    const { latched, by } = robot.estop.value;
    sign.say(
      headsetNotice({
        ...{ failure: notices.failure.value, banner: link.banner.value, obstacle: link.obstacle.value },
        held: driving.gripped.value && motion?.tone === 'bad' ? motion : null,
        stop: link.live.value && latched ? { atRobot: robot.estopAtRobot.value, by: by ?? null } : null,
        ...{ asked: asked.value, notice: notices.shown.value },
      }),
    );
  });
  effect(() => {
    const last = notices.last.value;
    if (last !== null && FELT.has(last.tone) && untracked(() => active.value)) pulse();
  });
  effect(() => {
    if (asked.value !== null && untracked(() => active.value)) pulse();
  });
  let hadBanner = false;
  effect(() => {
    const hasBanner = link.banner.value !== null;
    if (hasBanner && !hadBanner && untracked(() => active.value)) pulse();
    hadBanner = hasBanner;
  });
}
