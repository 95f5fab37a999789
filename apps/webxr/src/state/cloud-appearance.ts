/** How the page shows clouds: what each sensor's colours mean, which heights are drawn, and whether from above. */
import {
  COLOUR_MODES,
  type ColourMode,
  type HeightCut,
  isSoftwareRenderer,
  type ValueRange,
} from '@farpoint/cloud-view';
import { computed, effect, type ReadonlySignal, type Signal, signal } from '@preact/signals-core';

const KEY = 'farpoint.clouds';

/** As it was chosen in this browser. */
export function openAppearance(gl: WebGLRenderingContext | WebGL2RenderingContext): CloudAppearance {
  return new CloudAppearance(load(), store, !isSoftwareRenderer(gl));
}

/** The defaults if the page may not use local storage. */
function load(): StoredAppearance {
  try {
    return parseAppearance(localStorage.getItem(KEY));
  } catch {
    return parseAppearance(null);
  }
}

function store(appearance: StoredAppearance): void {
  try {
    localStorage.setItem(KEY, appearanceText(appearance));
  } catch {
    // Private browsing: what is chosen lasts for this visit only.
  }
}

/** How one sensor's cloud is coloured. */
export interface SensorLook {
  readonly mode: ColourMode;
  /** `null`: the range follows the points in view. */
  readonly fixed: Readonly<ValueRange> | null;
}

/** What the browser keeps between visits. */
export interface StoredAppearance {
  /** By the sensor's name, since a robot's sensors have no other identity. */
  readonly looks: ReadonlyMap<string, SensorLook>;
  /** Heights drawn when looking from the robot (also in VR), and from above. */
  readonly cut: Readonly<HeightCut>;
  readonly cutFromAbove: Readonly<HeightCut>;
  /** Seen from above, the robot's heading is up; otherwise north (the world's y axis). */
  readonly headingUp: boolean;
  /** Whether clouds of depth cameras are drawn as surfaces; `null`: as suits the renderer. */
  readonly surface: boolean | null;
  /** Whether what was seen is remembered; `null`: as suits the renderer. */
  readonly memory: boolean | null;
  /** Whether surfaces are painted with the video of their camera, where there is one. */
  readonly paint: boolean;
  /** Whether what the robot would hit, and missing floor, is tinted. */
  readonly hazards: boolean;
}

/** The cloud of a robot with one sensor, which has no name. */
export const UNNAMED = '';
/** More sensors than anybody has. The one changed longest ago is forgotten. */
const MAX_LOOKS = 32;
const MAX_NAME = 64;
/** Larger values mean nothing. */
const MAX_VALUE = 10_000;
/** Seen from above, ceilings hide everything else. */
const CEILING: HeightCut = { below: null, above: 2 };
/** The stream does not say what kind a sensor is. */
const LIDAR = /li-?dar|laser|velodyne|ouster|livox|hesai/i;

/** The look of a sensor that nobody has changed. A LiDAR has no colours of its own that a person would recognise. */
export function defaultLook(name: string): SensorLook {
  return { mode: LIDAR.test(name) ? 'height' : 'captured', fixed: null };
}

export class CloudAppearance {
  readonly looks: Signal<ReadonlyMap<string, SensorLook>>;
  readonly cut: Signal<Readonly<HeightCut>>;
  readonly cutFromAbove: Signal<Readonly<HeightCut>>;
  readonly headingUp: Signal<boolean>;
  readonly surface: Signal<boolean | null>;
  /** Whether clouds of depth cameras are drawn as surfaces, chosen or not. */
  readonly drawsSurface: ReadonlySignal<boolean>;
  readonly memory: Signal<boolean | null>;
  readonly paint: Signal<boolean>;
  readonly hazards: Signal<boolean>;
  /** Whether what was seen is remembered, chosen or not. */
  readonly remembers: ReadonlySignal<boolean>;
  /** Whether the flat screen shows the surroundings from above. Each visit begins with the robot's own view. */
  readonly fromAbove = signal(false);
  /** Whether the sensors' frusta are drawn. Each visit begins without them. */
  readonly frusta = signal(false);
  /** Whether the path and the map of the robot's navigator are drawn. Each visit begins with them. */
  readonly navigation = signal(true);
  /** Whether the robot's model is drawn. Each visit begins with it. */
  readonly model = signal(true);

  /**
   * @param store keeps every change
   * @param drawsFast whether clouds are drawn as surfaces, and what was seen is remembered, until somebody chooses
   */
  constructor(stored: StoredAppearance, store: (appearance: StoredAppearance) => void, drawsFast = false) {
    this.looks = signal(stored.looks);
    this.cut = signal(stored.cut);
    this.cutFromAbove = signal(stored.cutFromAbove);
    this.headingUp = signal(stored.headingUp);
    this.surface = signal(stored.surface);
    this.drawsSurface = computed(() => this.surface.value ?? drawsFast);
    this.memory = signal(stored.memory);
    this.paint = signal(stored.paint);
    this.hazards = signal(stored.hazards);
    this.remembers = computed(() => this.memory.value ?? drawsFast);
    let first = true;
    effect(() => {
      const { looks, cut, cutFromAbove, headingUp, surface, memory, paint, hazards } = this;
      const now = {
        looks: looks.value,
        cut: cut.value,
        cutFromAbove: cutFromAbove.value,
        headingUp: headingUp.value,
        surface: surface.value,
        memory: memory.value,
        paint: paint.value,
        hazards: hazards.value,
      };
      if (!first) store(now);
      first = false;
    });
  }

  lookOf(name: string): SensorLook {
    return this.looks.value.get(name) ?? defaultLook(name);
  }

  setLook(name: string, look: SensorLook): void {
    const others = [...this.looks.peek()].filter(([other]) => other !== name);
    this.looks.value = new Map([...others, [name, look] as const].slice(-MAX_LOOKS));
  }
}

/** The usable part of local storage. */
export function parseAppearance(text: string | null): StoredAppearance {
  let value: unknown;
  try {
    value = JSON.parse(text ?? '{}');
  } catch {
    value = {};
  }
  const record = recordOf(value);
  const looks = Object.entries(recordOf(record.looks)).flatMap(([name, look]) => {
    const { mode, fixed } = recordOf(look);
    const known = COLOUR_MODES.find((candidate) => candidate === mode);
    if (known === undefined || name.length > MAX_NAME) return [];
    return [[name, { mode: known, fixed: parseRange(fixed) }] as const];
  });
  return {
    looks: new Map(looks.slice(-MAX_LOOKS)),
    cut: parseCut(record.cut) ?? { below: null, above: null },
    cutFromAbove: parseCut(record.cutFromAbove) ?? CEILING,
    headingUp: record.headingUp !== false,
    surface: typeof record.surface === 'boolean' ? record.surface : null,
    memory: typeof record.memory === 'boolean' ? record.memory : null,
    paint: record.paint !== false,
    hazards: record.hazards === true,
  };
}

/** What {@link parseAppearance} reads. */
export function appearanceText({ looks, ...others }: StoredAppearance): string {
  return JSON.stringify({ ...others, looks: Object.fromEntries(looks) });
}

function parseRange(value: unknown): ValueRange | null {
  const { min, max } = recordOf(value);
  return isValue(min) && isValue(max) && min < max ? { min, max } : null;
}

function parseCut(value: unknown): HeightCut | null {
  const { below, above } = recordOf(value);
  if (below === undefined || above === undefined) return null;
  return { below: isValue(below) ? below : null, above: isValue(above) ? above : null };
}

function isValue(value: unknown): value is number {
  return typeof value === 'number' && Math.abs(value) <= MAX_VALUE;
}

function recordOf(value: unknown): Record<string, unknown> {
  return typeof value === 'object' && value !== null ? (value as Record<string, unknown>) : {};
}
