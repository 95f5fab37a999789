/** How the page itself looks: its colours, the size of its text, its language, and whether it moves. The robot's picture stays as it is. */
import * as z from 'zod/mini';
import { LANGUAGES } from './languages.ts';

const THEMES = ['system', 'dark', 'light', 'contrast'] as const;
type Theme = (typeof THEMES)[number];
/** `system`: the first of the browser's that the page speaks. */
const CHOSEN_LANGUAGES = ['system', ...LANGUAGES] as const;
const MOTIONS = ['system', 'reduced', 'full'] as const;

/**
 * Shares of the size that the page's text has by itself. WCAG 2.2, 1.4.4: text can be resized up to 200 %. Chosen: smaller
 * text than the page's own is read by nobody while driving.
 */
export const TEXT_SCALES = { least: 1, most: 2 } as const;

const textScaleSchema = z.number().check(z.minimum(TEXT_SCALES.least), z.maximum(TEXT_SCALES.most));

const storedSchema = z.object({
  theme: z.catch(z.enum(THEMES), 'system'),
  textScale: z.catch(textScaleSchema, 1),
  motion: z.catch(z.enum(MOTIONS), 'system'),
  language: z.catch(z.enum(CHOSEN_LANGUAGES), 'system'),
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

/** @param stored text from the browser's storage; a value in it that is not valid is as if nothing had been chosen */
export function parseDisplay(stored: string | null): DisplaySettings {
  try {
    return displayOf(JSON.parse(stored ?? '{}'));
  } catch {
    return displayOf({});
  }
}

/** @param value from storage or a form; whatever is not valid in it is replaced by its default */
export function displayOf(value: unknown): DisplaySettings {
  return storedSchema.parse(typeof value === 'object' && value !== null ? value : {});
}

/** The operator's choice comes before the system's. */
export function shownDisplay(settings: DisplaySettings, preference: DisplayPreference): ShownDisplay {
  const { theme, motion, textScale } = settings;
  const { reducedMotion } = preference;
  const wished = reducedMotion ? 'reduced' : 'full';
  return {
    theme: theme === 'system' ? systemTheme(preference) : theme,
    motion: motion === 'system' ? wished : motion,
    textScale,
  };
}

function systemTheme({ light, moreContrast }: DisplayPreference): ShownDisplay['theme'] {
  if (moreContrast) return 'contrast';
  return light ? 'light' : 'dark';
}
