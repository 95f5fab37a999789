/**
 * How colours are coded: not, by a transform with a step of 2 · 2^(quality/5) levels, or by the stream's palette. `coarse`
 * is for receivers that have better colours from elsewhere, e.g. a video: few bits for colour at any depth level.
 */
export type OrganisedColour =
  | 'none'
  | 'coarse'
  | 'palette'
  | {
      /** 0 (finest) to 31. */
      quality: number;
      /** Chroma at half the resolution (default), or at the resolution of luma. */
      chroma?: 'half' | 'full';
    };

/** In the binding's order. */
export const COLOUR_MODES = ['none', 'half', 'full', 'palette'] as const;
/** As within a budget. */
export const COARSE_COLOUR = { quality: 28, chroma: 'half' } as const;
/** Colours within a budget: as suits the depth, and these. */
export const BUDGET_COLOURS: readonly (OrganisedColour | null)[] = [null, 'coarse', 'palette'];
