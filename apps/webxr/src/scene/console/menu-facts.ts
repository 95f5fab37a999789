/** What the headset's menu and the labels on the controllers go by, from the page's state. */
import type { CommandStage, FrameStage, StageSummary } from '@farpoint/operator';
import { computed, type ReadonlySignal } from '@preact/signals-core';
import type { HeadsetSettings } from '../../ground/headset-settings.ts';
import type { CameraView } from '../../ground/pictures/camera-view.ts';
import type { PageState } from '../../state/page-state.ts';
import { steady } from '../../state/sampler.ts';
import { peopleShown } from '../../state/shown-people.ts';
import type { LabelFacts } from '../../words/controller-label-words.ts';
import { askedWords, waitingWords } from '../../words/handover-words.ts';
import { laterTexts } from '../../words/language.ts';
import { menuTimes } from '../../words/menu-times-words.ts';
import { emptyListWords } from '../../words/robots-words.ts';
import type { HeadsetRig } from '../headset/headset-rig.ts';
import type { MenuCamera, MenuFacts } from './menu-page.ts';

export interface ConsoleSources {
  readonly state: PageState;
  readonly headset: Pick<HeadsetRig, 'view'>;
  readonly passthrough: ReadonlySignal<boolean>;
  readonly settings: Pick<HeadsetSettings, 'turn'>;
  /** Of the last two seconds; of clouds `null` if none have come. */
  stages(nowMs: number): { clouds: StageSummary<FrameStage> | null; commands: StageSummary<CommandStage> };
}

export function menuFacts({
  state,
  headset,
  passthrough,
  stages,
}: ConsoleSources): ReadonlySignal<MenuFacts> {
  const { link, driving, robot, commands: offered } = state;
  const people = peopleShown(state);
  // Samples are taken all the time; the menu is drawn when something has changed.
  return steady(
    computed((): MenuFacts => {
      const { persons, mayAsk, hasHeirs } = people.value;
      const { clouds, commands } = stages(state.sampledAtMs.value);
      return {
        live: link.live.value,
        heard: link.heard.value,
        latched: robot.estopLatched.value,
        robots: link.robots.value.map(({ id, name }) => ({ id, name })),
        noRobots: emptyListWords(link.signaling.value, link.host).text,
        chosenRobotId: link.chosenRobotId.value,
        holder: driving.holder.value,
        mayTake: driving.mayTake.value,
        mayAsk,
        asked: askedOf(state),
        own: ownOf(state),
        hasHeirs,
        heirs: persons.filter(({ mayOffer }) => mayOffer).map(({ number, text }) => ({ number, text })),
        view: headset.view.value,
        cameras: state.views.value.map((view) => cameraOf(view, state)),
        commands: { groups: offered.groups.value, recording: offered.recording.value },
        mayPoint: state.people.mayPoint.value,
        readings: [
          ...robot.alarms.value,
          ...robot.readings.value.map(({ label, text, tone }) => ({
            text: laterTexts().headsetMenu.reading(label, text),
            tone,
          })),
        ],
        times: menuTimes(clouds, commands),
        passthrough: passthrough.value,
      };
    }),
  );
}

function askedOf({ people }: PageState): MenuFacts['asked'] {
  const asked = people.asked.value;
  if (asked === null) return null;
  const words = askedWords(asked);
  return { ...words, id: asked.id, text: laterTexts().headsetMenu.left(words.text, asked.leftS) };
}

function ownOf({ people }: PageState): MenuFacts['own'] {
  const own = people.own.value;
  if (own === null) return null;
  return { id: own.id, text: laterTexts().headsetMenu.left(waitingWords(own), own.leftS) };
}

function cameraOf(view: CameraView, { staged, enlarged }: PageState): MenuCamera {
  const { name, on } = view.camera;
  if (!on.value) return { name, shown: 'hidden' };
  if (staged.view.value === view) return { name, shown: 'filling' };
  return { name, shown: enlarged.view.value === view ? 'enlarged' : 'shown' };
}

/** Call this within an effect. @param gripped whether a hand drives @param menu whether the menu is open @param aims what points */
export function labelFacts(
  { state, headset, settings }: ConsoleSources,
  gripped: { readonly drives: boolean; readonly mustLetGo: boolean },
  menu: boolean,
  aims: LabelFacts['aims'],
): LabelFacts {
  const { link, driving, robot, views, sound } = state;
  return {
    live: link.live.value,
    chosen: link.connected.value,
    watches: driving.role.value === 'watch',
    otherDrives: driving.holder.value === 'other',
    latched: robot.estopLatched.value,
    mayRelease: robot.latchedStop.value?.mayRelease ?? false,
    gripped: gripped.drives,
    mustLetGo: gripped.mustLetGo,
    menu,
    mayPoint: state.people.mayPoint.value,
    aims,
    view: headset.view.value,
    pictures: views.value.some(({ camera }) => camera.on.value),
    speaks: sound.hasLoudspeaker.value,
    turns: settings.turn !== 'robot',
    nextRobot: link.nextRobot.value?.name ?? null,
  };
}
