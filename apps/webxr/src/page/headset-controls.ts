/** Connects the headset with the page: what its hands and buttons do to the view, besides driving. */
import { effect, untracked } from '@preact/signals-core';
import { HEADSET_VIEWS, type HeadsetView } from '../ground/headset-settings.ts';
import type { OperatorInputs } from '../panels/ui/operator-inputs.ts';
import type { ConsoleActions } from '../scene/console/console-actions.ts';
import type { ConsoleParts, VrConsole } from '../scene/console/vr-console.ts';
import { GrabbingHands } from '../scene/headset/grabbing-hands.ts';
import { HandsHeld } from '../scene/headset/hands-held.ts';
import type { NoticeSign } from '../scene/headset/notice-sign.ts';
import { type RayHit, RayPointer } from '../scene/view/ray-pointer.ts';
import type { Stage } from '../scene/view/stage.ts';
import type { PicturesInVr } from '../scene/view/vr-pictures.ts';
import type { VrSession } from '../scene/view/vr-session.ts';
import type { WristPanel } from '../scene/view/wrist-panel.ts';
import type { PageState } from '../state/page-state.ts';
import { viewNotice } from '../words/headset-words.ts';
import { loadLaterTexts, texts } from '../words/language.ts';

export interface HeadsetParts
  extends Pick<ConsoleParts, 'sources' | 'settings' | 'gripLost' | 'menuOpen' | 'floor' | 'feel'> {
  readonly stage: Pick<Stage, 'renderer' | 'rig' | 'camera' | 'headset' | 'world'>;
  readonly vr: VrSession;
  readonly inputs: OperatorInputs;
  readonly state: Pick<PageState, 'robot' | 'notices'>;
  readonly panel: WristPanel;
  readonly pictures: PicturesInVr;
  /** Before the operator's eyes. */
  readonly sign: NoticeSign;
  readonly actions: Omit<ConsoleActions, 'show' | 'pointAtFloor'>;
}

export class HeadsetControls {
  /** Menu and labels; `null` until VR is entered and their code is loaded. */
  console: VrConsole | null = null;
  readonly #parts: HeadsetParts;
  readonly #hands: GrabbingHands;
  readonly #held: HandsHeld;
  readonly #pointer: RayPointer;
  #readMs = 0;

  constructor(parts: HeadsetParts) {
    this.#parts = parts;
    const { stage, vr, inputs, sign } = parts;
    const { renderer, rig, camera, headset } = stage;
    this.#held = new HandsHeld(renderer, rig);
    this.#pointer = this.#openPointer();
    this.#hands = new GrabbingHands(renderer, rig, (index) => this.#mayGrab(index));
    camera.add(sign.object);
    vr.onHidden = () => {
      inputs.releaseAll();
      this.#hands.letGo();
      this.console?.letGo();
    };
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
    effect(() => {
      if (vr.active.value && this.console === null) void this.#loadConsole();
    });
  }

  /** Call this before each display frame in VR. */
  read(): void {
    const { stage, vr, inputs, sign, panel } = this.#parts;
    const { headset } = stage;
    const { console } = this;
    vr.update();
    headset.floorY = vr.floorY;
    const hands = this.#hands;
    const isTabletop = headset.view.peek() === 'tabletop';
    hands.update(headset.origin, isTabletop && !vr.hidden);
    if (isTabletop) headset.model.follow(hands.a, hands.b);
    const inMenu = console?.menu.isOpen.peek() ?? false;
    const isMenuPressed = inputs.readHeadset(vr.inputSources, this.#tracks, { grabbing: hands.hold, inMenu });
    if (isMenuPressed) console?.toggle();
    headset.turnStick = vr.hidden ? 0 : inputs.turnStick;
    panel.update(stage.camera);
    this.#pointer.update();
    const nowMs = performance.now();
    const { menuStick, otherGrip } = inputs;
    const stick = vr.hidden ? 0 : menuStick;
    console?.update({ stick, grip: otherGrip, barred: vr.hidden || hands.hold }, nowMs);
    sign.update(nowMs - this.#readMs);
    this.#readMs = nowMs;
  }

  /** The next view. Whoever drives lets go: what the hands do is about to look different. */
  nextView(): void {
    const at = HEADSET_VIEWS.indexOf(this.#parts.stage.headset.view.peek());
    this.show(HEADSET_VIEWS[(at + 1) % HEADSET_VIEWS.length] as HeadsetView);
  }

  show(view: HeadsetView): void {
    const { stage, inputs, state } = this.#parts;
    inputs.releaseAll();
    this.#hands.letGo();
    stage.headset.show(view);
    state.notices.tell(viewNotice(view));
  }

  /** A hand that drives, a trigger that releases the emergency stop, or one that chooses something holds nothing. */
  #mayGrab(index: number): boolean {
    const { stage, vr, inputs, state } = this.#parts;
    return (
      stage.headset.view.peek() === 'tabletop' &&
      !vr.hidden &&
      !inputs.isHeadsetGripped &&
      !state.robot.estopLatched.peek() &&
      this.console?.menu.isOpen.peek() !== true &&
      this.console?.isArmed !== true &&
      !this.#pointer.points(index)
    );
  }

  #openPointer(): RayPointer {
    const { stage, pictures, inputs, vr } = this.#parts;
    return new RayPointer(stage.renderer, stage.rig, {
      targets: () => [...(this.console?.targets() ?? []), ...pictures.targets()],
      onPointed: (hit, ray) => this.console?.point(hit, ray),
      onPressed: (hit) => {
        if (!vr.hidden && this.console?.press(hit) === true) inputs.claimTrigger(true);
      },
      onChosen: (hit, bare, ray) => {
        if (!vr.hidden) this.#choose(hit, bare, ray);
      },
      onOpened: () => {
        inputs.claimTrigger(false);
        this.console?.opened();
      },
    });
  }

  #choose(hit: RayHit | null, bare: boolean, ray: number): void {
    if (this.console?.choose(hit, bare, ray, performance.now()) === true) return;
    if (hit !== null) this.#parts.pictures.choose(hit.object);
  }

  async #loadConsole(): Promise<void> {
    const { stage, vr, inputs, state, actions, ...parts } = this.#parts;
    try {
      const [{ VrConsole }] = await Promise.all([import('../scene/console/vr-console.ts'), loadLaterTexts()]);
      this.console ??= new VrConsole({
        ...parts,
        rig: stage.rig,
        head: stage.camera,
        world: stage.world,
        pointer: this.#pointer,
        tell: (text) => state.notices.tell(text),
        origin: stage.headset.origin,
        hands: this.#held,
        active: vr.active,
        actions: { ...actions, show: (view) => this.show(view) },
        isGripped: () => inputs.isHeadsetGripped,
      });
    } catch {
      state.notices.tell(texts().headset.notLoaded, 'bad');
    }
  }

  readonly #tracks = (source: XRInputSource): boolean => this.#parts.vr.tracks(source);
}
