/** A departure of an implementation from the reference profile. */
export interface Finding {
  /** Short name of the rule, for lists. */
  rule: string;
  /** For people: what was observed. */
  detail: string;
}
