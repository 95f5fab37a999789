/** How the page itself looks: its colours, the size of its text, and whether it moves. The picture is not changed by it. */
import * as z from 'zod/mini';

export const THEMES = ['system', 'dark', 'light', 'contrast'] as const;
export type Theme = (typeof THEMES)[number];
export const MOTIONS = ['system', 'reduced', 'full'] as const;

/** Of the size that the browser's own settings ask for. */
export const LEAST_TEXT_SCALE = 0.8;
export const MOST_TEXT_SCALE = 2;

const storedSchema = z.object({
  theme: z.catch(z.enum(THEMES), 'system'),
  textScale: z.catch(z.number().check(z.minimum(LEAST_TEXT_SCALE), z.maximum(MOST_TEXT_SCALE)), 1),
  motion: z.catch(z.enum(MOTIONS), 'system'),
  /** Whether the screen stays on while a robot is shown. */
  awake: z.catch(z.boolean(), true),
});

export type DisplaySettings = Readonly<z.infer<typeof storedSchema>>;

/** What the browser or its system says of the operator's wishes. */
export interface DisplayPreference {
  readonly light: boolean;
  readonly moreContrast: boolean;
  readonly reducedMotion: boolean;
}

/** What the page's style sheets are told. */
export interface ShownDisplay {
  readonly theme: Exclude<Theme, 'system'>;
  readonly motion: 'reduced' | 'full';
  readonly textScale: number;
}

/** @param stored text from the browser's storage; what is not valid in it is as if nothing had been chosen */
export function parseDisplay(stored: string | null): DisplaySettings {
  try {
    const value: unknown = JSON.parse(stored ?? '{}');
    return storedSchema.parse(typeof value === 'object' && value !== null ? value : {});
  } catch {
    return storedSchema.parse({});
  }
}

/** The operator's choice comes before the system's. */
export function shownDisplay(settings: DisplaySettings, preference: DisplayPreference): ShownDisplay {
  const { theme, motion, textScale } = settings;
  return { theme: shownTheme(theme, preference), motion: shownMotion(motion, preference), textScale };
}

function shownTheme(theme: Theme, { light, moreContrast }: DisplayPreference): ShownDisplay['theme'] {
  if (theme !== 'system') return theme;
  if (moreContrast) return 'contrast';
  return light ? 'light' : 'dark';
}

function shownMotion(
  motion: DisplaySettings['motion'],
  { reducedMotion }: DisplayPreference,
): ShownDisplay['motion'] {
  if (motion !== 'system') return motion;
  return reducedMotion ? 'reduced' : 'full';
}
