/** Connects the headset with the page: what its hands and buttons do to the view, besides driving. */
import { effect, untracked } from '@preact/signals-core';
import { HEADSET_VIEWS, type HeadsetView } from '../ground/headset-settings.ts';
import type { OperatorInputs } from '../panels/ui/operator-inputs.ts';
import { GrabbingHands } from '../scene/headset/grabbing-hands.ts';
import type { NoticeSign } from '../scene/headset/notice-sign.ts';
import type { PicturePointer } from '../scene/view/picture-pointer.ts';
import type { Stage } from '../scene/view/stage.ts';
import type { VrSession } from '../scene/view/vr-session.ts';
import type { PageState } from '../state/page-state.ts';
import { viewNotice } from '../words/headset-words.ts';

export interface HeadsetParts {
  readonly stage: Pick<Stage, 'renderer' | 'rig' | 'camera' | 'headset'>;
  readonly vr: VrSession;
  readonly inputs: OperatorInputs;
  readonly state: Pick<PageState, 'robot' | 'notices'>;
  readonly pointer: PicturePointer;
  /** Before the operator's eyes. */
  readonly sign: NoticeSign;
}

export class HeadsetControls {
  readonly #parts: HeadsetParts;
  readonly #hands: GrabbingHands;
  #readMs = 0;

  constructor(parts: HeadsetParts) {
    this.#parts = parts;
    const { stage, vr, inputs, state, pointer, sign } = parts;
    const { renderer, rig, camera, headset } = stage;
    // A hand that drives, a trigger that releases the emergency stop, or one that chooses a picture holds nothing.
    this.#hands = new GrabbingHands(
      renderer,
      rig,
      (index) =>
        headset.view.peek() === 'tabletop' &&
        !vr.hidden &&
        !inputs.isHeadsetGripped &&
        !state.robot.estopLatched.peek() &&
        !pointer.pointsAtPicture(index),
    );
    camera.add(sign.object);
    vr.onHidden = () => {
      inputs.releaseAll();
      this.#hands.letGo();
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
  }

  /** Call this before each display frame in VR. */
  read(): void {
    const { stage, vr, inputs, pointer, sign } = this.#parts;
    const { headset } = stage;
    vr.update();
    headset.floorY = vr.floorY;
    const hands = this.#hands;
    const isTabletop = headset.view.peek() === 'tabletop';
    hands.update(headset.origin, isTabletop && !vr.hidden);
    if (isTabletop) headset.model.follow(hands.a, hands.b);
    inputs.readHeadset(vr.inputSources, this.#tracks, hands.hold);
    headset.turnStick = vr.hidden ? 0 : inputs.turnStick;
    pointer.update();
    const nowMs = performance.now();
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

  readonly #tracks = (source: XRInputSource): boolean => this.#parts.vr.tracks(source);
}
