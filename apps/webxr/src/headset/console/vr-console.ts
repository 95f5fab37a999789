/** The headset's console: labels on the controllers, notices before the eyes, a menu, and what the wrist says. */
import { computed, effect, signal, untracked } from '@preact/signals-core';
import type { Object3D, Vector3 } from 'three';
import type { PageState } from '../../state/page-state.ts';
import { steady } from '../../state/steady.ts';
import { controlWords } from '../../status/controller-label-words.ts';
import { menuAnswers, menuTakeBack } from '../../status/handover-words.ts';
import { shownPeople } from '../../status/people-words.ts';
import type { PointerHit } from '../../view/picture-pointer.ts';
import type { Stage } from '../../view/stage.ts';
import type { VrSession } from '../../view/vr-session.ts';
import type { WristPanel } from '../../view/wrist-panel.ts';
import type { HeadsetSettings } from '../headset-settings.ts';
import type { ConsoleActions } from './console-actions.ts';
import { ControllerLabels } from './controller-labels.ts';
import { HandsHeld } from './hands-held.ts';
import { labelFacts } from './label-facts.ts';
import type { MenuPageName } from './menu-page.ts';
import { MenuPanel } from './menu-panel.ts';
import { MenuState } from './menu-state.ts';
import { MenuStick } from './menu-stick.ts';
import { NoticeSign } from './notice-sign.ts';
import { showNoticesInVr } from './show-notices.ts';
import { WristTab } from './wrist-tab.ts';

export interface ConsoleParts {
  readonly settings: HeadsetSettings;
  readonly state: PageState;
  readonly stage: Pick<Stage, 'renderer' | 'rig' | 'camera' | 'headset'>;
  readonly vr: VrSession;
  readonly panel: WristPanel;
  readonly actions: Omit<
    ConsoleActions,
    'toggleReadings' | 'toggleVideo' | 'togglePictures' | 'pressCommand'
  >;
  /** The menu opens: whatever the hands hold, they let go of. */
  letGo(): void;
  /** Lets the controllers vibrate. */
  pulse(): void;
}

export class VrConsole {
  /** Whether the wrist shows all readings. */
  readonly readings = signal(true);
  readonly menu: MenuState;
  readonly sign = new NoticeSign();
  readonly labels: readonly ControllerLabels[] = [
    new ControllerLabels('left'),
    new ControllerLabels('right'),
  ];
  readonly #parts: ConsoleParts;
  readonly #panel: MenuPanel;
  readonly #tab = new WristTab();
  readonly #stick = new MenuStick();
  readonly #hands: HandsHeld;
  /** The row that each ray is at. */
  readonly #pointed = [-1, -1];
  #beganMs = 0;
  #lastMs = 0;

  constructor(parts: ConsoleParts) {
    this.#parts = parts;
    const { stage, state, vr, panel, pulse } = parts;
    this.#hands = new HandsHeld(stage.renderer, stage.rig);
    this.menu = new MenuState(this.#menuFacts(), this.#actions());
    this.#panel = new MenuPanel(this.menu);
    stage.camera.add(this.sign.object);
    stage.rig.add(this.#panel.object, ...this.labels.map(({ object }) => object));
    panel.addBelow(this.#tab.object);
    showNoticesInVr({ state, sign: this.sign, active: vr.active, pulse });
    this.#label();
    effect(() => {
      const active = vr.active.value;
      const alone = !state.link.connected.value;
      untracked(() => {
        if (!active) this.menu.close();
        // Without a robot there is nothing to do in the headset but to choose one.
        else if (alone) this.open('robots');
      });
    });
    effect(() => {
      const active = vr.active.value;
      // With STOP on, and in the menu, the same controls do something else.
      void state.robot.estopLatched.value;
      void this.menu.isOpen.value;
      this.#beganMs = performance.now();
      if (!active) this.#hide();
    });
  }

  /** Opens the menu before the operator's eyes. Whoever drives lets go. */
  open(page: MenuPageName = 'main'): void {
    this.#parts.letGo();
    this.#stick.reset();
    this.menu.open(page);
    this.#panel.placeAnew();
  }

  toggle(): void {
    if (this.menu.isOpen.peek()) this.menu.close();
    else this.open();
  }

  /** What rays can hit. While the menu is open, nothing else. */
  targets(others: readonly Object3D[]): readonly Object3D[] {
    const tab = this.#tab.object;
    return this.menu.isOpen.peek() ? [this.#panel.target, tab] : [...others, tab];
  }

  /** A ray is at one of the targets. One that rests leaves the mark to the sticks. */
  point({ object, uv }: PointerHit, ray: number): void {
    if (object !== this.#panel.target || uv === undefined) return;
    const row = this.#panel.rowAt(uv.y);
    if (row === this.#pointed[ray]) return;
    this.#pointed[ray] = row;
    this.menu.mark(row);
  }

  /** The trigger was pulled at one of the targets, or it was pinched. @returns whether it is the console's */
  choose({ object, uv }: PointerHit): boolean {
    if (uv === undefined) return false;
    if (object === this.#panel.target) this.menu.choose(this.#panel.rowAt(uv.y));
    else if (object !== this.#tab.object) return false;
    else if (this.#tab.partAt(uv.x) === 'menu') this.toggle();
    else this.#parts.actions.stop();
    return true;
  }

  /** A stick moves the mark. @param deflection backwards, −1…1 */
  steer(deflection: number): void {
    const by = this.#stick.read(deflection);
    if (by !== 0 && this.menu.isOpen.peek()) this.menu.step(by);
  }

  /** Call this before each display frame in VR. Allocates nothing. */
  update(nowMs: number): void {
    const elapsedMs = nowMs - this.#lastMs;
    this.#lastMs = nowMs;
    this.sign.update(elapsedMs);
    const { camera } = this.#parts.stage;
    this.#panel.update(camera);
    for (let hand = 0; hand < this.labels.length; hand++)
      this.labels[hand]?.update(camera, nowMs - this.#beganMs, elapsedMs);
  }

  /** Middle of each row of the open menu, in the world. */
  rowPlaces(): Vector3[] {
    return this.#panel.rowPlaces();
  }

  /** Middles of STOP and of the menu on the wrist, in the world; empty while hands have buttons for them. */
  tabPlaces(): Vector3[] {
    return this.#tab.object.visible ? this.#tab.places() : [];
  }

  #hide(): void {
    for (const { object } of this.labels) object.visible = false;
  }

  #label(): void {
    const { state, stage, settings, vr } = this.#parts;
    for (const labels of this.labels) {
      effect(() => {
        labels.grip = this.#hands.of(labels.hand)?.grip ?? null;
      });
    }
    effect(() => {
      this.#tab.object.visible = this.#hands.of(settings.driveHand)?.hasButtons !== true;
    });
    effect(() => {
      if (!vr.active.value) return;
      const facts = labelFacts(state, stage.headset, settings, this.menu.isOpen.value);
      for (const labels of this.labels) {
        const { hand } = labels;
        labels.say(controlWords(facts, hand, hand === settings.driveHand ? 'drives' : 'views'));
      }
    });
  }

  #menuFacts() {
    const { state, stage, vr } = this.#parts;
    const { link, driving, robot, people } = state;
    const facts = computed(() => ({
      ...{ link: link.line.value.text, live: link.live.value, robots: link.robots.value },
      ...{ latched: robot.estopLatched.value, chosenRobotId: link.chosenRobotId.value },
      ...{ holder: driving.holder.value, mayTake: driving.mayTake.value },
      ...{ asked: menuAnswers(people.asked.value), waiting: menuTakeBack(people.own.value) },
      mayAsk: driving.mayTake.value && people.own.value === null,
      offerable: this.#offerable(),
      ...{ view: stage.headset.view.value, readings: this.readings.value },
      ...{ passthrough: vr.passthrough.value, commands: state.commands.shown.value },
      cameras: [
        ...state.videos.switches.all.value.map((each) => ({ kind: 'video' as const, each })),
        ...state.cameras.all.value.map((each) => ({ kind: 'pictures' as const, each })),
      ].map(({ kind, each: { index, name, on } }) => ({ kind, index, name, on: on.value })),
    }));
    // Samples are taken all the time; the menu is drawn when something has changed.
    return steady(facts);
  }

  #offerable() {
    const { robot, driving, people } = this.#parts.state;
    const { persons } = shownPeople({
      ...{ operators: robot.operators.value, role: driving.role.value, holder: driving.holder.value },
      ...{ waits: people.own.value !== null, drivesMinutes: null },
    });
    return persons.filter(({ mayOffer }) => mayOffer).map(({ number, text }) => ({ number, text }));
  }

  #actions(): ConsoleActions {
    const { state, actions } = this.#parts;
    return {
      ...actions,
      toggleVideo: (index) => state.videos.switches.toggle(index),
      togglePictures: (index) => state.cameras.toggle(index),
      pressCommand: (id) => state.commands.press(id),
      toggleReadings: () => {
        this.readings.value = !this.readings.peek();
      },
    };
  }
}
