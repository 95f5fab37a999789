/** What the labels on the controllers tell of, from the page's state. */
import type { PageState } from '../../state/page-state.ts';
import type { LabelFacts } from '../../status/controller-label-words.ts';
import type { HeadsetRig } from '../headset-rig.ts';
import type { HeadsetSettings } from '../headset-settings.ts';

/** Call this within an effect. */
export function labelFacts(
  { link, driving, robot, views, sound }: PageState,
  headset: Pick<HeadsetRig, 'view'>,
  { turn }: Pick<HeadsetSettings, 'turn'>,
  menu: boolean,
): LabelFacts {
  return {
    ...{ live: link.live.value, chosen: link.connected.value, menu, view: headset.view.value },
    watches: driving.role.value === 'watch',
    otherDrives: driving.holder.value === 'other',
    latched: robot.estopLatched.value,
    atRobot: robot.estopAtRobot.value,
    gripped: driving.gripped.value,
    mustLetGo: driving.gripLost.value !== null,
    pictures: views.value.some(({ camera }) => camera.on.value),
    speaks: sound.hasLoudspeaker.value,
    turns: turn !== 'robot',
    nextRobot: link.nextRobot.value?.name ?? null,
  };
}
