/** Rewrites TypeScript's declarations for a tarball: no `.ts` addresses, no private packages, no schemas. */
export interface PublicDeclaration {
  text: string;
  /** Types that are made of a schema's: nobody outside can see what they hold. */
  opaque: string[];
}
/**
 * A declaration file as users of the package get it. Schemas are left out with the library that they are made of: the
 * types beside them say the same. Types that are made of a schema become `unknown`.
 *
 * @param nameOf the address of a package's declarations; the name itself where it stays
 * @throws {Error} where something else is made of a schema
 */
export declare function publicDeclaration(text: string, nameOf: (name: string) => string): PublicDeclaration;
/** The relative addresses that a declaration file imports from. */
export declare function references(text: string): string[];
