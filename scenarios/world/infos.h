#pragma once

#include <string>

#include "components/config/parameter_info.h"

/// Keys of a scenario whose reader is code, for the schema of scenario files.
namespace ensonify {

/// `ensonify: scenario/1` at the head of a file.
ParameterInfo format_info(const std::string& format);
ParameterInfo text_info(const std::string& key, const std::string& about, bool required = false);
ParameterInfo file_info(const std::string& key, const std::string& about, bool required = true);
ParameterInfo word_info(const std::string& key, const std::string& about, Allowed words);
/// A list of classes of the seabed.
ParameterInfo classes_info(const std::string& key, const std::string& about);
/// A file's path, or a map.
ParameterInfo file_or_info(const std::string& key, const std::string& about, const ParameterList& map);
/// One word, or a map.
ParameterInfo word_or_info(const std::string& key, const std::string& about, const std::string& word,
                           const ParameterList& map);
/// A map from names of a pattern to words or maps.
ParameterInfo words_or_maps_info(const std::string& key, const std::string& about, const std::string& names,
                                 const Allowed& words, const ParameterList& map);
/// A list of maps, each with the keys of one of the sections in `forms`.
ParameterInfo forms_info(const std::string& key, const std::string& about, const ParameterList& forms);

}  // namespace ensonify
