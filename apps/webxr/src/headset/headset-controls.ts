/** Connects the headset with the page: what its hands and buttons do to the view, besides driving. */
import { effect, untracked } from '@preact/signals-core';
import type { PageState } from '../state/page-state.ts';
import { HEADSET_VIEW_WORDS } from '../status/headset-words.ts';
import type { OperatorInputs } from '../ui/operator-inputs.ts';
import { PicturePointer } from '../view/picture-pointer.ts';
import type { Stage } from '../view/stage.ts';
import type { PicturesInVr } from '../view/vr-pictures.ts';
import type { VrSession } from '../view/vr-session.ts';
import type { WristPanel } from '../view/wrist-panel.ts';
import type { ConsoleActions } from './console/console-actions.ts';
import { VrConsole } from './console/vr-console.ts';
import { GrabbingHands } from './grabbing-hands.ts';
import type { HeadsetSettings } from './headset-settings.ts';
import { HEADSET_VIEWS, type HeadsetView } from './rig-pose.ts';

export interface HeadsetParts {
  readonly settings: HeadsetSettings;
  readonly stage: Pick<Stage, 'renderer' | 'rig' | 'camera' | 'headset'>;
  readonly vr: VrSession;
  readonly inputs: OperatorInputs;
  readonly state: PageState;
  readonly panel: WristPanel;
  readonly pictures: PicturesInVr;
  readonly actions: Omit<
    ConsoleActions,
    'show' | 'toggleReadings' | 'toggleVideo' | 'togglePictures' | 'pressCommand'
  >;
  /** Lets the controllers vibrate. */
  pulse(): void;
}

export class HeadsetControls {
  readonly #parts: HeadsetParts;
  readonly #hands: GrabbingHands;
  readonly #pointer: PicturePointer;
  /** On the wrist. */
  readonly panel: WristPanel;
  /** Labels, notices and the menu. */
  readonly console: VrConsole;

  constructor(parts: HeadsetParts) {
    this.#parts = parts;
    this.panel = parts.panel;
    const { stage, vr, pictures } = parts;
    const { renderer, rig, headset } = stage;
    // A hand that drives, a trigger that releases the emergency stop, or one that chooses a picture holds nothing.
    this.#hands = new GrabbingHands(
      renderer,
      rig,
      (index) => headset.view.peek() === 'tabletop' && !vr.hidden && this.isTriggerFree(index),
    );
    this.console = new VrConsole({
      ...parts,
      actions: { ...parts.actions, show: (view) => this.show(view) },
      letGo: () => this.#letGo(),
    });
    this.#pointer = new PicturePointer(renderer, rig, {
      targets: () => this.console.targets(pictures.targets()),
      onPointed: (hit, ray) => this.console.point(hit, ray),
      onChosen: (hit) => {
        if (!this.console.choose(hit)) pictures.choose(hit.object);
      },
    });
    vr.onHidden = () => this.#letGo();
    vr.onRecentre = ({ position, orientation }) => headset.recentre(position, orientation);
    vr.onReset = () => headset.begin();
    let before: HeadsetView | null = null;
    effect(() => {
      const passthrough = vr.passthrough.value;
      headset.passthrough = passthrough;
      untracked(() => {
        // In one's own room, the model on the table is what one expects first.
        if (passthrough) {
          before = headset.view.peek();
          this.show('tabletop');
        } else if (before !== null) {
          headset.show(before);
          before = null;
        }
      });
    });
  }

  /** Call this before each display frame in VR. */
  read(): void {
    const { stage, vr, inputs } = this.#parts;
    const menu = this.console.menu.isOpen.peek();
    const { headset } = stage;
    vr.update();
    headset.floorY = vr.floorY;
    const hands = this.#hands;
    const isTabletop = headset.view.peek() === 'tabletop';
    hands.update(headset.origin, isTabletop && !vr.hidden);
    if (isTabletop) headset.model.follow(hands.a, hands.b);
    const pressed = inputs.readHeadset(vr.inputSources, this.#tracks, hands.hold, menu);
    if (pressed.menu) this.console.toggle();
    if (pressed.choose) this.console.menu.choose();
    this.console.steer(inputs.menuStick);
    headset.turnStick = vr.hidden ? 0 : inputs.turnStick;
    this.#pointer.update();
    this.console.update(performance.now());
  }

  /**
   * Whether the trigger of this controller, 0 or 1, means nothing by itself now: no grip drives, it releases no emergency
   * stop, no menu is open, and it points at nothing that it would choose.
   */
  isTriggerFree(index: number): boolean {
    const { inputs, state } = this.#parts;
    if (inputs.isHeadsetGripped || state.robot.estopLatched.peek()) return false;
    return !this.console.menu.isOpen.peek() && !this.#pointer.points(index);
  }

  /** The next view. Whoever drives lets go: what the hands do is about to look different. */
  nextView(): void {
    const at = HEADSET_VIEWS.indexOf(this.#parts.stage.headset.view.peek());
    this.show(HEADSET_VIEWS[(at + 1) % HEADSET_VIEWS.length] as HeadsetView);
  }

  show(view: HeadsetView): void {
    const { stage, state } = this.#parts;
    this.#letGo();
    stage.headset.show(view);
    state.notices.tell(`View in the headset: ${HEADSET_VIEW_WORDS[view].toLowerCase()}`);
  }

  #letGo(): void {
    this.#parts.inputs.releaseAll();
    this.#hands.letGo();
  }

  readonly #tracks = (source: XRInputSource): boolean => this.#parts.vr.tracks(source);
}
