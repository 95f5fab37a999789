/**
 * The panel for clouds: what their colours mean, as colour bars to read values off, and the controls for it. It has
 * no field to type in and no control keeps the focus after a click, because both would take keys from driving.
 */
import { type CloudView, DROP_TINT, type HeightCut, HIT_TINT, type Rgb } from '@farpoint/cloud-view';
import {
  type BodyHeights,
  MemoryFileError,
  POINT_FILE_FORMATS,
  type PointFileFormat,
} from '@farpoint/operator';
import { effect, type ReadonlySignal, type Signal, signal, untracked } from '@preact/signals-core';
import type { Switches } from '../../ground/switches.ts';
import { type CloudAppearance, UNNAMED } from '../../state/cloud-appearance.ts';
import type { RobotState } from '../../state/robot-state.ts';
import { hazardLegendWords } from '../../words/hazard-words.ts';
import { texts } from '../../words/language.ts';
import { fixed, grouped } from '../../words/numbers.ts';
import { colourControls } from './colour-controls.ts';
import { elements } from './elements.ts';
import { followKey } from './key-title.ts';
import { cssOf, type Legend, legendOf } from './legend.ts';
import { quietButton, rowOf, selectOf, sliderOf } from './panel-parts.ts';
import type { RememberedWorld } from './remembered-world.ts';
import { saveFile } from './save-file.ts';

export interface MemoryControlsParts {
  readonly remembered: Pick<RememberedWorld, 'forget' | 'save' | 'load'>;
  tell(text: string, tone: 'good' | 'warning'): void;
}

/** Whether what was seen is remembered; and buttons that forget, save and load it. */
function memoryControls(
  { memory, remembers }: CloudAppearance,
  { remembered, tell }: MemoryControlsParts,
): HTMLElement {
  const said = texts().clouds;
  const toggle = quietButton(said.memory, said.memoryTitle, () => {
    memory.value = !remembers.peek();
  });
  const forget = quietButton(said.forget, said.forgetTitle, () => remembered.forget());
  const save = quietButton(said.save, said.saveTitle, () => void saveWorld());
  const load = quietButton(said.load, said.loadTitle, () => input.click());
  let format: PointFileFormat = 'ply';
  const formats = selectOf(
    { label: said.format, values: POINT_FILE_FORMATS, texts: said.formats },
    (chosen) => {
      format = chosen;
    },
  );
  const input = document.createElement('input');
  Object.assign(input, { type: 'file', accept: '.ply,.pcd', hidden: true });
  input.ariaLabel = said.loadLabel;
  const group = document.createElement('div');
  const file = rowOf(said.file, save, load, input);
  const as = rowOf(said.saveAs, formats);
  const anew = rowOf(said.anew, forget);
  input.addEventListener('change', () => void loadFile(input.files?.[0]));
  effect(() => {
    toggle.ariaPressed = String(remembers.value);
    for (const row of [file, as, anew]) row.hidden = !remembers.value;
  });
  group.append(rowOf(said.keep, toggle), file, as, anew);
  return group;

  async function saveWorld(): Promise<void> {
    try {
      const bytes = await remembered.save(format);
      if (bytes === null) return;
      saveFile('world', format.slice(0, 3), new Blob([bytes], { type: 'application/octet-stream' }));
    } catch (error) {
      if (!(error instanceof MemoryFileError)) throw error;
      tell(said.cannotSave(error.message), 'warning');
    }
  }

  async function loadFile(file: File | undefined): Promise<void> {
    input.value = '';
    if (file === undefined) return;
    try {
      const points = await remembered.load(file);
      tell(said.loaded(grouped(points), file.name), 'good');
    } catch (error) {
      if (!(error instanceof MemoryFileError)) throw error;
      tell(said.cannotLoad(file.name, error.message), 'warning');
    }
  }
}

/** Metres above the robot's ground. The outer end of each slider draws everything. */
const ABOVE = { min: 0, max: 6, step: 0.1 };
const BELOW = { min: -2, max: 2, step: 0.1 };

/** Which heights of the clouds are drawn in the present view; and what is up when looking from above. */
function cutControls(appearance: CloudAppearance): HTMLElement {
  const said = texts().clouds;
  const group = document.createElement('div');
  const inUse = () => (appearance.fromAbove.value ? appearance.cutFromAbove : appearance.cut);
  const change = (part: Partial<HeightCut>) => {
    const cut = inUse();
    cut.value = { ...cut.peek(), ...part };
  };
  const above = sliderOf(said.hideAboveLabel, ABOVE, (height) =>
    change({ above: height >= ABOVE.max ? null : height }),
  );
  const below = sliderOf(said.hideBelowLabel, BELOW, (height) =>
    change({ below: height <= BELOW.min ? null : height }),
  );
  const [aboveText, belowText] = [document.createElement('output'), document.createElement('output')];
  const up = quietButton(said.headingUp, said.upTitle, () => {
    appearance.headingUp.value = !appearance.headingUp.peek();
  });
  const upRow = rowOf(said.up, up);
  group.append(rowOf(said.hideAbove, above, aboveText), rowOf(said.hideBelow, below, belowText), upRow);
  effect(() => {
    const cut = inUse().value;
    above.value = String(cut.above ?? ABOVE.max);
    below.value = String(cut.below ?? BELOW.min);
    aboveText.value = heightText(cut.above);
    belowText.value = heightText(cut.below);
  });
  effect(() => {
    upRow.hidden = !appearance.fromAbove.value;
    up.textContent = appearance.headingUp.value ? said.headingUp : said.northUp;
  });
  return group;
}

function heightText(height: number | null): string {
  return height === null ? texts().measures.nothing : `${fixed(height, 1)} m`;
}

/** What gives way in the column of figures takes the mouse and the keys only while there is something in it to be scrolled to. */
function markCut(): void {
  const { facts, noGpu, people } = elements;
  const update = () => {
    for (const part of [facts, noGpu, people]) {
      const isCut = part.scrollHeight > part.clientHeight + 1;
      part.classList.toggle('cut', isCut);
      if (part === facts) part.tabIndex = isCut ? 0 : -1;
    }
  };
  const observer = new ResizeObserver(update);
  for (const watched of [elements.hud, facts, noGpu, people]) observer.observe(watched);
}

export interface CloudPanelParts {
  readonly appearance: CloudAppearance;
  /** Empty for a robot with one sensor. */
  readonly sensors: Switches;
  readonly views: ReadonlySignal<readonly CloudView[]>;
  readonly memory: MemoryControlsParts;
  readonly robot: Pick<RobotState, 'heights'>;
}

export class CloudPanel {
  readonly #parts: CloudPanelParts;
  #legends: readonly Legend[] = [];

  constructor(parts: CloudPanelParts) {
    this.#parts = parts;
    const { appearance } = parts;
    const said = texts().clouds;
    const open = signal(false);
    const fromAbove = quietButton(said.fromAbove, said.fromAboveTitle, () => {
      appearance.fromAbove.value = !appearance.fromAbove.peek();
    });
    fromAbove.id = 'from-above';
    followKey(fromAbove, 'from-above');
    const colours = quietButton(said.colours, said.coloursTitle, () => {
      open.value = !open.peek();
    });
    colours.id = 'colours-open';
    const legends = element('legends');
    const controls = element('controls');
    const heads = element('heads');
    heads.append(fromAbove, colours);
    elements.clouds.append(heads, legends, controls);
    markCut();
    effect(() => {
      fromAbove.ariaPressed = String(appearance.fromAbove.value);
    });
    effect(() => {
      colours.ariaExpanded = String(open.value);
      controls.hidden = !open.value;
    });
    effect(() => {
      this.#legends = this.#sensors().flatMap(({ name, on, view }) => (on ? this.#legendOf(name, view) : []));
      const hazards = appearance.hazards.value ? [hazardLegend(parts.robot.heights.value)] : [];
      legends.replaceChildren(...this.#legends.map((legend) => legend.element), ...hazards);
    });
    const ofSensors = element('');
    const drawing = [surfaceControls(appearance), memoryControls(appearance, parts.memory)];
    const drawn = [hazardSwitch, frustaSwitch, navigationSwitch, modelSwitch].map((made) => made(appearance));
    controls.append(ofSensors, ...drawing, cutControls(appearance), ...drawn);
    effect(() => {
      const parts = this.#names().map((name, i) =>
        untracked(() =>
          colourControls(name, appearance, () => this.#parts.views.peek()[i]?.colouring.range ?? null),
        ),
      );
      ofSensors.replaceChildren(...parts.map((part) => part.element));
      return () => {
        for (const { dispose } of parts) dispose();
      };
    });
  }

  /** Brings the numbers up to date. Call it a few times a second. */
  update(): void {
    for (const legend of this.#legends) legend.update();
  }

  #names(): string[] {
    const all = this.#parts.sensors.all.value;
    return all.length === 0 ? [UNNAMED] : all.map(({ name }) => name);
  }

  #sensors(): { name: string; on: boolean; view: CloudView | undefined }[] {
    const { sensors, views } = this.#parts;
    return this.#names().map((name, i) => ({
      name,
      view: views.value[i],
      on: sensors.all.value[i]?.on.value ?? true,
    }));
  }

  #legendOf(name: string, view: CloudView | undefined): Legend[] {
    const { mode } = this.#parts.appearance.lookOf(name);
    if (mode === 'captured' || view === undefined) return [];
    return [legendOf(name === UNNAMED ? '' : `${name}: `, mode, view)];
  }
}

function hazardSwitch({ hazards }: CloudAppearance): HTMLElement {
  const said = texts().clouds;
  const button = quietButton('', said.hazardsSwitchTitle, () => {
    hazards.value = !hazards.peek();
  });
  button.id = 'hazards';
  followKey(button, 'hazards');
  effect(() => {
    button.textContent = hazards.value ? said.tinted : said.notTinted;
    button.ariaPressed = String(hazards.value);
  });
  return rowOf(said.hazards, button);
}

function frustaSwitch({ frusta }: CloudAppearance): HTMLElement {
  const button = drawnButton(frusta, texts().clouds.frustaTitle);
  button.id = 'frusta';
  return rowOf(texts().clouds.frusta, button);
}

function navigationSwitch({ navigation }: CloudAppearance): HTMLElement {
  const button = drawnButton(navigation, texts().clouds.navigationTitle);
  button.id = 'navigation';
  return rowOf(texts().clouds.navigation, button);
}

function modelSwitch({ model }: CloudAppearance): HTMLElement {
  const button = drawnButton(model, texts().clouds.modelTitle);
  button.id = 'robot-model';
  return rowOf(texts().clouds.model, button);
}

function drawnButton(drawn: Signal<boolean>, title: string): HTMLButtonElement {
  const button = quietButton('', title, () => {
    drawn.value = !drawn.peek();
  });
  effect(() => {
    const said = texts().clouds;
    button.textContent = drawn.value ? said.drawn : said.notDrawn;
    button.ariaPressed = String(drawn.value);
  });
  return button;
}

function element(className: string): HTMLElement {
  const made = document.createElement('div');
  made.className = className;
  return made;
}

/** Whether clouds on a camera’s grid are drawn as a surface or as points, and what paints the surface. */
function surfaceControls({ surface, drawsSurface, paint }: CloudAppearance): HTMLElement {
  const said = texts().clouds;
  const button = quietButton(said.surfaces, said.surfacesTitle, () => {
    surface.value = !drawsSurface.peek();
  });
  const video = quietButton(said.video, said.videoTitle, () => {
    paint.value = !paint.peek();
  });
  const group = document.createElement('div');
  const painting = rowOf(said.paint, video);
  effect(() => {
    button.ariaPressed = String(drawsSurface.value);
    video.ariaPressed = String(paint.value);
    painting.hidden = !drawsSurface.value;
  });
  group.append(rowOf(said.draw, button), painting);
  return group;
}

/** What the tints of hazards stand for. @param heights `null`: the robot does not say which heights matter to it */
function hazardLegend(heights: BodyHeights | null): HTMLElement {
  const words = hazardLegendWords(heights);
  const figure = document.createElement('figure');
  figure.className = 'legend overlay hazards';
  figure.title = texts().clouds.hazardsTitle;
  if (words.unknown === undefined) figure.append(swatch(HIT_TINT, words.hit), swatch(DROP_TINT, words.drop));
  else {
    const caption = document.createElement('figcaption');
    caption.textContent = words.unknown;
    figure.append(caption);
  }
  return figure;
}

function swatch(tint: Rgb, text: string): HTMLElement {
  const row = document.createElement('div');
  const colour = document.createElement('span');
  row.className = 'swatch';
  colour.style.background = cssOf(tint);
  row.append(colour, text);
  return row;
}
