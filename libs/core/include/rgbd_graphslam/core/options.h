/** Options structs and the ini files they live in. Each struct describes its fields once; loading,
 *  range checks, printing and the commented default ini all follow from that description. */
#pragma once
#include <map>
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** Sees every field of an options struct in turn. */
class OptionVisitor {
  public:
    virtual ~OptionVisitor() = default;
    /** \param unit of the value, "" for a pure number; \param help one line */
    virtual void real(const char* key, double& value, double min, double max, const char* unit,
                      const char* help) = 0;
    virtual void integer(const char* key, int& value, int min, int max, const char* unit,
                         const char* help) = 0;
    virtual void flag(const char* key, bool& value, const char* help) = 0;
    virtual void choice(const char* key, std::string& value,
                        const std::vector<std::string>& allowed, const char* help) = 0;
    /** Key that an earlier version had for `key`, described next; files that have it are read with
     * a notice. */
    virtual void renamed(const char* /*old_key*/, const char* /*key*/) {}
};

/** Base of every options struct; the ini section has the struct's name. */
struct Options {
    virtual ~Options() = default;
    virtual const char* section() const = 0;
    /** One line saying what the section is for. */
    virtual const char* about() const = 0;
    virtual void describe(OptionVisitor& visitor) = 0;
};

/** An ini file as MRPT reads it (`//`, `;` and `#` comments, `key = value  // unit`), which
 *  remembers the line of every key so that a mistake can be named. */
class IniFile {
  public:
    /** \throws Error when the file is missing or a line is neither section, key nor comment */
    static IniFile fromFile(const std::string& path);
    /** \param name stands for the file in error messages */
    static IniFile fromText(const std::string& text, const std::string& name);

    /** Overrides one value.
     *  \param assignment "section.key=value"
     *  \throws Error when it has another form */
    void override(const std::string& assignment);

    /** Fills the structs; keys that are absent leave the field as it is. Keys by their former names
     *  are read, too, with one notice each.
     *  \throws Error naming file and line for an unknown section or key, a value that is no number,
     *          not finite or out of its range */
    void load(const std::vector<Options*>& structs) const;

    /** As load, but for one part of a program that shares its ini with others: sections of other
     *  structs are left alone. */
    void loadKnown(const std::vector<Options*>& structs) const;

  private:
    struct Entry {
        std::string value;
        std::string origin;  // "file:line" or "--set"
    };
    std::map<std::string, std::map<std::string, Entry>> sections_;
};

/** A commented ini text with the present values of the structs; IniFile::load reads it back to the
 *  same values. */
std::string toIniText(const std::vector<Options*>& structs);

}  // namespace rgbd_graphslam
