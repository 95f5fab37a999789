/**
 * The headset's console: a menu beside the line of sight, labels on the controllers, STOP and the menu on the wrist. Its code is
 * loaded when VR is entered.
 */
import type { GripLoss } from '@farpoint/operator';
import type { Spot } from '@farpoint/protocol';
import { computed, effect, type ReadonlySignal, type Signal, signal, untracked } from '@preact/signals-core';
import { type Group, type Object3D, Vector3 } from 'three';
import { HANDS, type Hand, type HeadsetSettings, otherHand } from '../../ground/headset-settings.ts';
import { controlWords } from '../../words/controller-label-words.ts';
import { laterTexts } from '../../words/language.ts';
import type { HandsHeld } from '../headset/hands-held.ts';
import type { NoticeSign } from '../headset/notice-sign.ts';
import type { RayHit } from '../view/ray-pointer.ts';
import type { WristPanel } from '../view/wrist-panel.ts';
import type { ConsoleActions } from './console-actions.ts';
import { ControllerLabels, type LabelView } from './controller-labels.ts';
import type { AimBy, AimReading } from './floor-aim.ts';
import { type Floor, FloorPointer, type FloorPointerParts } from './floor-pointer.ts';
import { type ConsoleSources, labelFacts, menuFacts } from './menu-facts.ts';
import type { MenuPage } from './menu-page.ts';
import { MenuPanel } from './menu-panel.ts';
import { MenuState } from './menu-state.ts';
import { MenuStick } from './menu-stick.ts';
import { ViewBox } from './view-box.ts';
import { ViewFrame } from './view-frame.ts';
import { WristTab } from './wrist-tab.ts';

export interface ConsoleParts {
  readonly sources: ConsoleSources;
  readonly settings: HeadsetSettings;
  /** Carries the tracked space. */
  readonly rig: Group;
  /** The operator's head, a child of the rig. */
  readonly head: Object3D;
  /** Where ahead is in the tracked space. */
  readonly origin: { readonly yaw: number };
  readonly hands: HandsHeld;
  readonly panel: WristPanel;
  readonly sign: NoticeSign;
  /** Is told whether the menu is open. */
  readonly menuOpen: Signal<boolean>;
  /** Whether VR is active. */
  readonly active: ReadonlySignal<boolean>;
  readonly actions: Omit<ConsoleActions, 'pointAtFloor'>;
  /** The robot's world. */
  readonly world: Object3D;
  readonly pointer: FloorPointerParts['pointer'];
  readonly floor: Floor;
  /** A hand feels that what it did is done. */
  feel(hand: Hand): void;
  /** Says what there is to do. */
  tell(text: string): void;
  /** Whether the grip is held, whether or not it drives. */
  isGripped(): boolean;
  /** Why a grip that is held does not drive; `null` if it does, or if none is. */
  gripLost(): GripLoss | null;
}

/** What {@link VrConsole.update} goes by. */
export interface ConsoleReading {
  /** Deflection backwards of the stick that moves the mark, −1…1. */
  readonly stick: number;
  readonly grip: AimReading['grip'];
  /** A hand holds the model, or the headset is away. */
  readonly barred: boolean;
}

/** What it shows, for tests: places in the view are degrees right of and above the way ahead. */
export interface ShownConsole {
  menu: {
    title: string;
    items: string[];
    /** Below each entry; empty where there is none. */
    notes: string[];
    marked: number;
    letterDegrees: number;
    box: Box;
    /** The middle of each entry, in the tracked space, m. */
    places: Place[];
  } | null;
  labels: { hand: string; texts: string[]; letterDegrees: number; box: Box }[];
  sign: Box | null;
  wrist: Box | null;
  /** Where hands that aim are at the floor, by ray. */
  aim: readonly (Spot | null)[];
  /** The middles of STOP and of the menu on the wrist, in the tracked space, m. */
  tab: { stop: Place; menu: Place };
}

type Place = [x: number, y: number, z: number];

type Box = Pick<ViewBox, 'left' | 'right' | 'bottom' | 'top'>;

export class VrConsole {
  readonly menu: MenuState;
  readonly #parts: ConsoleParts;
  readonly #panel: MenuPanel;
  readonly #tab = new WristTab();
  readonly #stick = new MenuStick();
  readonly #labels = HANDS.map((hand) => new ControllerLabels(hand));
  readonly #menuBox = new ViewBox();
  readonly #signBox = new ViewBox();
  readonly #view: LabelView;
  /** The entry that each ray is at, and the page on which it is. */
  readonly #pointed = [-1, -1];
  readonly #pointedOn: (MenuPage | null)[] = [null, null];
  readonly #floor: FloorPointer;
  #hasPointed = false;
  /** What points at the floor. */
  readonly #aims = signal<AimBy>(null);
  /** Whether each ray is at something that is before the floor. */
  readonly #covered = [false, false];
  /** When the headset was put on, and the last frame; `null` before the first one. */
  #beganMs: number | null = null;
  #lastMs = 0;

  constructor(parts: ConsoleParts) {
    this.#parts = parts;
    const { sources, rig, head, panel, active } = parts;
    this.#floor = new FloorPointer(parts);
    this.menu = new MenuState(menuFacts(sources), { ...parts.actions, pointAtFloor: () => this.#arm() });
    this.#panel = new MenuPanel(this.menu);
    this.#view = {
      head,
      frame: new ViewFrame(),
      taken: [this.#menuBox, this.#signBox],
      sinceMs: 0,
      elapsedMs: 0,
      menuOpen: false,
      passthrough: false,
    };
    rig.add(this.#panel.object, ...this.#labels.map(({ object }) => object));
    panel.addBelow(this.#tab.sheet);
    this.#label();
    effect(() => {
      this.#view.passthrough = sources.passthrough.value;
    });
    effect(() => {
      parts.menuOpen.value = this.menu.isOpen.value;
    });
    effect(() => {
      if (active.value) return;
      untracked(() => this.#leave());
    });
  }

  /** Opens the menu beside where the head looks, or closes it. While a hand drives, it stays closed. */
  toggle(): void {
    if (this.menu.isOpen.peek()) {
      this.menu.close();
      return;
    }
    if (this.#parts.isGripped()) return;
    this.#stick.reset();
    this.#pointed.fill(-1);
    this.menu.open();
    this.#panel.place(this.#parts.head, this.#parts.origin.yaw);
  }

  /** What rays can hit: nothing behind the menu, while that is open. */
  targets(): readonly Object3D[] {
    return this.menu.isOpen.peek() ? [this.#panel.sheet, this.#tab.sheet] : [this.#tab.sheet];
  }

  /** A ray is at one of the targets, or not. One that rests leaves the mark to the stick. */
  point(hit: RayHit | null, ray: number): void {
    this.#covered[ray] = hit !== null;
    const entry = this.#entryOf(hit) ?? -1;
    const page = this.menu.page.peek();
    const isNewPage = page !== this.#pointedOn[ray];
    this.#pointedOn[ray] = page;
    if (entry === this.#pointed[ray]) return;
    this.#pointed[ray] = entry;
    // Not the ray has moved, but what it is at.
    if (isNewPage && this.menu.isBySteps) return;
    this.menu.mark(entry);
  }

  /** Whether the next trigger points at the floor, or one that is still pulled has done so. */
  get isArmed(): boolean {
    return this.#floor.by === 'trigger' || this.#hasPointed;
  }

  /** A trigger or a hand has opened. */
  opened(): void {
    this.#hasPointed = false;
  }

  /** A trigger is pulled, or a hand pinches. @returns whether it is the console's */
  press(hit: RayHit | null): boolean {
    if (hit === null) return this.isArmed;
    if (hit.object === this.#tab.sheet) {
      if (this.#tab.partAt(hit.uv?.x ?? 0) === 'stop') this.#parts.actions.stop();
      return true;
    }
    return hit.object === this.#panel.sheet;
  }

  /**
   * A trigger was pulled and let go, or a hand has pinched.
   *
   * @param bare whether it is a bare hand: that has no stick, so it chooses only what it points at
   * @returns whether it was the console's
   */
  choose(hit: RayHit | null, bare: boolean, ray: number, nowMs: number): boolean {
    if (hit === null && this.#floor.take(ray)) {
      this.#hasPointed = true;
      return true;
    }
    if (hit?.object === this.#tab.sheet) {
      if (this.#tab.partAt(hit.uv?.x ?? 0) === 'menu') this.toggle();
      return true;
    }
    const isOpen = this.menu.isOpen.peek();
    const entry = this.#entryOf(hit);
    if (isOpen && (entry !== null || !bare)) this.menu.choose(entry, nowMs);
    return isOpen;
  }

  /** Call this before each display frame in VR. */
  update({ stick, grip, barred }: ConsoleReading, nowMs: number): void {
    const { rig, head, origin, isGripped } = this.#parts;
    const view = this.#view;
    const gripped = isGripped();
    // Whoever drives looks where the robot goes.
    if (gripped && this.menu.isOpen.peek()) this.menu.close();
    const by = this.#stick.read(stick);
    if (by !== 0 && this.menu.isOpen.peek()) this.menu.step(by);
    this.menu.update(nowMs);
    this.#aim(grip, barred, gripped, nowMs);
    view.frame.update(rig, head, origin.yaw);
    this.#beganMs ??= nowMs;
    view.sinceMs = nowMs - this.#beganMs;
    view.elapsedMs = view.sinceMs === 0 ? 0 : nowMs - this.#lastMs;
    view.menuOpen = this.menu.isOpen.peek();
    this.#lastMs = nowMs;
    this.#panel.update(view.elapsedMs);
    this.#measure();
    for (let index = 0; index < this.#labels.length; index++) this.#labels[index]?.update(view);
  }

  /** For tests. */
  get shown(): ShownConsole {
    const { sign, panel } = this.#parts;
    const page = this.menu.page.peek();
    const wrist = new ViewBox();
    if (panel.shown !== null) {
      this.#view.frame.add(panel.sheet, wrist);
      this.#view.frame.add(this.#tab.sheet, wrist);
    }
    return {
      menu: page && {
        title: page.title,
        items: page.items.map(({ text }) => text),
        notes: page.items.map(({ note = '' }) => note),
        marked: this.menu.marked.peek(),
        letterDegrees: this.#panel.letterDegrees,
        box: boxOf(this.#menuBox),
        places: page.items.map((_, entry) =>
          this.#placeOf(this.#panel.object, 0, this.#panel.middleOf(entry)),
        ),
      },
      labels: this.#labels
        .filter(({ object }) => object.visible)
        .map(({ hand, shown, letterDegrees, box }) => ({
          hand,
          texts: shown,
          letterDegrees,
          box: boxOf(box),
        })),
      aim: this.#floor.spots,
      sign: sign.shown === null ? null : boxOf(this.#signBox),
      wrist: wrist.isEmpty ? null : boxOf(wrist),
      tab: {
        stop: this.#placeOf(this.#tab.sheet, -this.#tab.quarterM, 0.5),
        menu: this.#placeOf(this.#tab.sheet, this.#tab.quarterM, 0.5),
      },
    };
  }

  #arm(): void {
    this.#floor.arm(performance.now());
    this.#parts.tell(laterTexts().headsetMenu.pointNow);
  }

  #aim(grip: ConsoleReading['grip'], isAway: boolean, drives: boolean, nowMs: number): void {
    const { sources, settings } = this.#parts;
    const isUnseen = !sources.state.people.mayPoint.peek();
    const barred = isAway || isUnseen || this.menu.isOpen.peek();
    this.#floor.update({ grip, barred, drives }, otherHand(settings.driveHand), this.#covered, nowMs);
    this.#aims.value = this.#floor.by;
  }

  /** @param below in the object's own measure */
  #placeOf(object: Object3D, right: number, below: number): Place {
    const at = new Vector3(right, -below, 0).applyMatrix4(object.matrixWorld);
    return this.#parts.rig.worldToLocal(at).toArray();
  }

  #entryOf(hit: RayHit | null): number | null {
    if (hit === null || hit.object !== this.#panel.sheet) return null;
    return this.#panel.entryAt(hit.uv?.y ?? 1);
  }

  #measure(): void {
    const { frame } = this.#view;
    this.#menuBox.clear();
    if (this.menu.isOpen.peek()) frame.add(this.#panel.sheet, this.#menuBox);
    this.#signBox.clear();
    if (this.#parts.sign.sheet.visible) frame.add(this.#parts.sign.sheet, this.#signBox);
  }

  /** Hands that aim aim no more: the headset is away. */
  letGo(): void {
    this.#aim('away', true, false, this.#lastMs);
  }

  #leave(): void {
    this.menu.close();
    this.letGo();
    this.#panel.clear();
    this.#beganMs = null;
    for (const labels of this.#labels) labels.hide();
  }

  #label(): void {
    const { sources, settings, hands, active } = this.#parts;
    for (const labels of this.#labels) {
      effect(() => {
        labels.grip = hands.of(labels.hand);
      });
    }
    const gripped = computed(() => {
      void sources.state.sampledAtMs.value;
      return this.#parts.isGripped();
    });
    const mustLetGo = computed(() => {
      void sources.state.sampledAtMs.value;
      return this.#parts.gripLost() !== null;
    });
    effect(() => {
      if (!active.value) return;
      const grip = { drives: gripped.value && !mustLetGo.value, mustLetGo: mustLetGo.value };
      const facts = labelFacts(sources, grip, this.menu.isOpen.value, this.#aims.value);
      for (const labels of this.#labels) {
        const drives = labels.hand === settings.driveHand;
        labels.say(controlWords(facts, labels.hand, drives), !drives);
      }
    });
  }
}

function boxOf({ left, right, bottom, top }: ViewBox): Box {
  return { left, right, bottom, top };
}
